// A scene: all that determines the simulation, besides the motion of the device. Plain data; read from TOML
// by scene_file.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/scene/burr.h"
#include "common/scene/fixture.h"
#include "common/scene/plan.h"
#include "common/scene/rating.h"
#include "common/scene/stiffness_relation.h"

namespace osteomill {

/// A bone made by code: one of phantom_names.
struct PhantomSource {
    std::string name = "tooth";

    bool operator==(const PhantomSource&) const = default;
};

/// A bone from a file that bone_import wrote (HU on an isotropic, axis-aligned LPS grid).
struct FileSource {
    std::filesystem::path path;
    std::optional<double> threshold_hu{};  ///< bone is at and above this; absent: what the file itself says
    std::filesystem::path segmentation{};  ///< where its tissues are, on the bone's grid; empty: nowhere

    bool operator==(const FileSource&) const = default;
};

/// Strength of a tissue against cutting, relative to the bone for which the burrs' coefficients hold.
struct TissueStrength {
    std::string material{};           ///< preset that both are from (material.h); empty: the scene's own
    double relative_stiffness = 1.0;  ///< of the chips, in place of the value from CT numbers
    double relative_edge = 1.0;       ///< of edges that rub

    bool operator==(const TissueStrength&) const = default;
};

/// Whether reports use this name for a sum, so that no tissue may have it.
inline bool is_name_of_sum(std::string_view name) {
    return name == "total" || name == "unlabelled";
}

/// Greatest thickness of bone that shows what is behind it.
inline constexpr double most_shows_through_mm = 3.0;

/// Thickness of bone below which a tissue shows, if the scene gives none: as surgeons see sinus and nerves.
inline double usual_shows_through_mm(bool is_protected) {
    return is_protected ? 1.5 : 0.0;
}

struct Tissue {
    std::uint8_t label = 0;  ///< 1 to 255; 0 is "unlabelled"
    std::string name{};
    std::array<std::uint8_t, 3> colour_rgb{};
    bool is_protected = false;                 ///< touching it with a turning burr raises a warning
    std::optional<TissueStrength> strength{};  ///< absent: from its CT numbers
    double stiffness_factor = 1.0;             ///< factor of the stiffness by its strength or CT numbers
    bool is_cuttable = true;                   ///< false: no burr takes it, it is a wall
    std::string segment{};                     ///< of the segmentation that it is; empty: none
    double opacity = 1.0;                      ///< of its picture, 0 (not drawn) to 1
    double warn_mm = 0.0;                      ///< a burr nearer than this is warned of; 0: none is
    double shows_through_mm = 0.0;             ///< bone thinner than this shows its colour; 0: none does
    double shows_through_strength = 1.0;       ///< share of its colour under hardly any bone, 0 to 1
    /// Colour by which files of other programs identify it (FIVRS); absent: its own colour.
    std::optional<std::array<std::uint8_t, 3>> identifier_rgb{};

    bool operator==(const Tissue&) const = default;
};

inline const std::array<std::uint8_t, 3>& identifier_of(const Tissue& tissue) {
    return tissue.identifier_rgb ? *tissue.identifier_rgb : tissue.colour_rgb;
}

/// Device space to patient space: p_patient = rotation * (scale * p_device) + offset.
/// Forces go back by the transposed rotation, unscaled.
struct DeviceMapping {
    glm::dmat3 rotation{1.0};  ///< device axes to patient LPS; orthonormal
    double scale = 1.0;        ///< patient mm per device mm
    glm::dvec3 offset_mm{0.0};

    bool operator==(const DeviceMapping&) const = default;
};

/// Position of the burr's centre and direction of the spindle (unit vector from tip to shank), patient LPS.
struct ToolPose {
    glm::dvec3 position_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};

    bool operator==(const ToolPose&) const = default;
};

/// Motions that code makes. `polishing`: along the surface of a block to and fro, ever deeper. `cavity`:
/// plunge along the spindle, then circle outwards and deeper to clear a round hole.
enum class BuiltInTrajectory { hold, polishing, cavity };
inline constexpr std::array trajectory_names{"hold", "polishing", "cavity"};

/// The target that a simulated hand follows. Lengths are in patient space.
struct TrajectorySpec {
    std::variant<BuiltInTrajectory, std::filesystem::path> source = BuiltInTrajectory::hold;
    glm::dvec3 start_mm{
        0.0};  ///< cavity: centre of the mouth of the hole; polishing: first point of the surface
    glm::dvec3 travel_direction{1.0, 0.0, 0.0};  ///< polishing: along the slide
    double speed_mm_per_s = 6.0;
    double depth_mm = 3.5;  ///< of the burr's lowest point below start
    double width_mm = 4.5;  ///< cavity: diameter of the hole; polishing: length of the slide

    bool operator==(const TrajectorySpec&) const = default;
};

struct Scene {
    std::string name{};
    std::string description{};  ///< a sentence for people, as on the start page; may be empty
    std::variant<PhantomSource, FileSource> bone = PhantomSource{};
    StiffnessRelation stiffness = default_stiffness_relation();
    std::vector<Tissue> tissues;
    std::vector<Burr> burrs;  ///< never empty
    std::size_t start_burr = 0;
    double wall_friction = 0.2;    ///< Coulomb's, of a burr at rest on bone
    bool feed_forward = false;     ///< the coupling's, of bone's change (feed_forward.h)
    double force_scale = 1.0;      ///< factor of cutting forces: for arms whose friction hides them
    std::optional<Motor> motor{};  ///< whose speed falls under load, as it is heard
    DeviceMapping device;
    ToolPose start_pose;
    TrajectorySpec trajectory;
    std::optional<Plan> plan{};       ///< the goal of a session
    PassMarks pass{};                 ///< marks that it has to reach
    Rating rating{};                  ///< items that earn it points
    std::vector<Fixture> fixtures{};  ///< virtual fixtures that help the hand by force

    bool operator==(const Scene&) const = default;
};

/// The scene's burrs as the hand feels them: their coefficients times its force_scale.
std::vector<Burr> felt_burrs(const Scene& scene);

/// The scene's relation of stiffness to CT numbers, with the tissues that have a stiffness of their own.
StiffnessRelation stiffness_of(const Scene& scene);

// Factors by which the edge forces in a tissue exceed those that its stiffness implies; the edge forces of
// scenes with such tissues are weighted by them.

/// By tissue label: relative edge force over relative stiffness.
struct EdgeShares {
    EdgeShares() { of_label.fill(1.0f); }
    explicit EdgeShares(const std::vector<Tissue>& tissues) : EdgeShares() {
        for (const Tissue& tissue : tissues)
            if (tissue.strength)
                of_label[tissue.label] =
                    static_cast<float>(tissue.strength->relative_edge / tissue.strength->relative_stiffness);
    }

    /// In every tissue edges rub as its stiffness implies.
    bool are_all_one() const {
        return std::all_of(of_label.begin(), of_label.end(), [](float share) { return share == 1.0f; });
    }

    std::array<float, 256> of_label;
};

/// Tissues that no burr cuts, such as an implant or a probe's tip: they stay, and are a wall to the burr.
struct UncutTissues {
    UncutTissues() = default;
    explicit UncutTissues(const std::vector<Tissue>& tissues) {
        for (const Tissue& tissue : tissues) {
            of_label[tissue.label] = !tissue.is_cuttable;
            has_any = has_any || !tissue.is_cuttable;
        }
    }

    bool has_any = false;
    std::array<bool, 256> of_label{};  ///< by tissue label
};

/// The burrs of a scene, each turning at its own speed or at the one that was chosen.
class TurningBurrs {
  public:
    explicit TurningBurrs(std::vector<Burr> burrs) : burrs_(std::move(burrs)) {
        for (const Burr& burr : burrs_) own_rev_per_s_.push_back(burr.spindle_rev_per_s);
    }

    std::size_t size() const { return burrs_.size(); }
    const std::vector<Burr>& all() const { return burrs_; }
    const Burr& operator[](std::size_t burr) const { return burrs_[burr]; }

    /// Lets a burr turn at a share of its own speed from now on. Real-time safe.
    const Burr& turn(std::size_t burr, double speed_share) noexcept {
        burrs_[burr].spindle_rev_per_s = speed_share * own_rev_per_s_[burr];
        return burrs_[burr];
    }

  private:
    std::vector<Burr> burrs_;
    std::vector<double> own_rev_per_s_;
};

// Names of the bones made by code, in the order in which people see them.

/// Each has a scene of its name, scenes/NAME.toml.
inline constexpr std::array phantom_names{"jaw", "mastoid", "tooth", "cube", "head"};

}  // namespace osteomill
