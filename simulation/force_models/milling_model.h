// Milling model, the default force model: it owns the bone, carves it along the path of the burr, sums the
// cutting force of the removed bone, and samples the engagement. One thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/burr_profile.h"
#include "common/scene/scene.h"
#include "simulation/carving/carve.h"
#include "simulation/carving/full_scan.h"
#include "simulation/carving/instruction_set.h"
#include "simulation/carving/voxel_coverage.h"
#include "simulation/cutting_force/axis_face.h"
#include "simulation/cutting_force/binned_force.h"
#include "simulation/cutting_force/edge_look.h"
#include "simulation/cutting_force/instantaneous_force.h"
#include "simulation/engagement/engagement_probe.h"
#include "simulation/exchange/milling_step.h"
#include "simulation/force_models/force_model.h"
#include "simulation/force_models/removal_account.h"

namespace osteomill {

// How the model carves and how it sums: --force-model chooses these settings, and studies vary them.

/// How the force is summed over the bone that a step removed.
enum class ForceSummation {
    voxels,   ///< the mean over the step, directly over voxels (mean_force.h)
    bins,     ///< the same over bins [psi, z], as published (binned_force.h)
    instants  ///< within the tooth period (instantaneous_force.h)
};

/// How a step finds the bone that it removes.
enum class VoxelSearch {
    crescent,  ///< only voxels that two positions of the burr do not share (carve.h)
    full_scan  ///< every voxel of the burr, as published (full_scan.h)
};

struct MillingSettings {
    bool has_edge_forces = true;  ///< false: the published law, whatever the burrs' edge coefficients
    ForceSummation summation = ForceSummation::voxels;
    ChipBins bins{};              ///< of ForceSummation::bins
    int instants_per_tooth = 20;  ///< of ForceSummation::instants
    VoxelCoverage coverage = VoxelCoverage::smoothed;
    VoxelSearch search = VoxelSearch::crescent;
    InstructionSet instructions = best_instruction_set();
};

class MillingModel final : public ForceModel {
  public:
    /// `burrs` and `tissues` as in the scene. Throws std::invalid_argument for an empty burr set, a burr
    /// whose values are not finite and positive or that is more than 500 voxels across, and settings out of
    /// range.
    MillingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues,
                 const MillingSettings& settings = {});

    /// Moves the burr, carves the bone on its path (only while the spindle is on), reports the changes and
    /// overwrites `result`. The first step, and the first with another burr, starts at the command's pose
    /// without a sweep. A command that is not finite, of no duration or of an unknown burr leaves bone and
    /// burr alone and makes the result invalid. Real-time safe.
    void step(const BurrCommand& command, double time_s, ChangeSink& changes,
              MillingResult& result) noexcept override;

    void restore(const BrickChange& change, BrickFractions fractions, ChangeSink& changes) noexcept override;

    std::unique_ptr<ForceModel> copy() const override { return std::make_unique<MillingModel>(*this); }

    const Bone& bone() const override { return bone_; }
    RemovedByTissue removed_mm3() const override { return account_.removed_mm3(); }
    double removed_mm3(std::size_t label) const override { return account_.removed_mm3(label); }

  private:
    /// Motion of the burr's farthest point to the command's pose: along the path and, for a head that is no
    /// ball, by the spindle's tilt.
    double motion_mm(const BurrCommand& command) const noexcept;
    /// Whether the command's position is so near to position_mm_ that milling can wait for the next step.
    bool can_wait(const BurrCommand& command) const noexcept;
    /// From position_mm_ to the command's position, in substeps.
    void mill(const BurrCommand& command, ChangeSink& changes, MillingResult& result) noexcept;
    /// One substep, from position_mm_ to the position of `to`, which becomes position_mm_, with the spindle
    /// as `to` has it; adds to `result`, force weighed by `share` of the path.
    void cut(const BurrCommand& command, const ToolPose& to, double share, ChangeSink& changes,
             MillingResult& result) noexcept;
    /// Adds the bone on which edges rub, from the step's start to `ahead` of it.
    template <typename Force>
    EdgeLook look_ahead(const Sweep& sweep, const CuttingStep& cutting, const glm::dvec3& ahead,
                        const CarveSettings& carving, Force& force) noexcept;
    template <typename Force>
    void carve_and_sum(const Sweep& sweep, const CuttingStep& cutting, double share, ChangeSink& changes,
                       Force& force, MillingResult& result) noexcept;

    Bone bone_;
    TurningBurrs burrs_;
    std::vector<EngagementProbe> probes_;            // by burr
    std::vector<std::optional<BurrProfile>> heads_;  // likewise, in voxels; nothing for a ball
    std::vector<FullScan> scans_;                    // likewise; none but for VoxelSearch::full_scan
    MillingSettings settings_;
    AxisFace axis_face_;
    EdgeGrowth edge_growth_;
    EdgeShares edge_shares_;
    bool has_edge_shares_;
    UncutTissues uncut_;
    BinnedForce chips_;
    InstantaneousForce tooth_;
    RemovalAccount account_;

    bool has_position_ = false;        // position_mm_ holds where the burr last milled, or was
    bool carved_at_position_ = false;  // the burr_ carved at position_mm_
    glm::dvec3 position_mm_{0.0};
    glm::dvec3 spindle_axis_{0.0, 0.0, 1.0};  // there
    std::size_t burr_ = 0;
    double since_milled_s_ = 0.0;
    glm::dvec3 milled_force_n_{0.0};  // of the path that was last milled
};

}  // namespace osteomill
