// A case from which sessions are made: its scene, its bone, and the places of its protected structures.
// Loaded once, never changed, and shared by any number of sessions in any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "analysis/report/planned_region.h"
#include "common/bone/distance_field.h"
#include "common/scene/burr_clearance.h"
#include "common/session/tool_state.h"
#include "haptic_server/session/session_scene.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill::python {

/// In the order of a step's numbers.
struct StepNames {
    std::vector<std::string> tissues{};
    std::vector<std::string> structures{};

    bool operator==(const StepNames&) const = default;
};

class LoadedCase {
  public:
    /// Loads it, for as long as that takes; the bone of `similar` is shared if it is the same. Throws in one
    /// line as load_session_scene does.
    LoadedCase(std::string name, SceneChoice choice, const LoadedCase* similar = nullptr);

    const std::string& name() const { return name_; }
    const SceneChoice& choice() const { return choice_; }
    /// A session takes a copy, whose bone shares all but the bricks that it mills.
    const SessionScene& scene() const { return scene_; }
    const Scene& settings() const { return scene_.scene; }
    std::uint64_t bone_checksum() const { return bone_checksum_; }

    /// The tissues by which removed bone is counted, and the label of each; "unlabelled" is one of them if
    /// the bone has such voxels.
    struct NamedLabel {
        std::string name;
        std::size_t label;
    };
    const std::vector<NamedLabel>& labels() const { return labels_; }
    /// Their names, and those of the structures, by which steps are read.
    std::shared_ptr<const StepNames> step_names() const { return step_names_; }
    /// Labels of the tissues that the bone had.
    const std::vector<std::size_t>& labels_of_bone() const { return labels_of_bone_; }

    /// Names of the protected structures.
    const std::vector<std::string>& structures() const { return structure_names_; }
    /// The scene's burrs as the hand feels them.
    const std::vector<Burr>& felt_burrs() const { return felt_burrs_; }

    bool has_plan() const { return scene_.scene.plan.has_value(); }
    /// Distance from a place, patient LPS, to the planned region; 0 and below: within, so deep. Infinite if
    /// the bone has none of the region. The first call finds the region. The case must have a plan.
    double plan_distance_mm(const glm::dvec3& place_mm) const;

    /// Distance from the burr's head to structure number `i`, mm; 0 and below: they overlap, so deep;
    /// infinite: beyond reach.
    double distance_mm(std::size_t i, const ToolState& tool) const noexcept;

  private:
    std::string name_;
    SceneChoice choice_;
    SessionScene scene_;
    std::uint64_t bone_checksum_;
    std::vector<NamedLabel> labels_;
    std::vector<std::size_t> labels_of_bone_;
    std::vector<std::string> structure_names_;
    std::shared_ptr<const StepNames> step_names_;
    std::vector<DistanceField> fields_;
    std::vector<double> reach_mm_;
    std::vector<BurrClearance> heads_;
    std::vector<Burr> felt_burrs_;
    struct Planned {
        SessionInfo session;
        PlannedRegion region;
        Planned(const Bone& bone, SessionInfo info) : session(std::move(info)), region(bone, session) {}
    };
    mutable std::once_flag planned_once_;
    mutable std::unique_ptr<const Planned> planned_;
};

}  // namespace osteomill::python
