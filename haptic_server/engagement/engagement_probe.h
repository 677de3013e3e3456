// Sampling of the bone around one burr and its shank into an engagement map (engagement.h).
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/burr.h"
#include "common/scene/edge_shares.h"
#include "common/scene/uncut_tissues.h"
#include "haptic_server/engagement/brick_neighbourhood.h"
#include "haptic_server/engagement/burr_patches.h"
#include "haptic_server/engagement/engagement.h"
#include "haptic_server/engagement/shank_probe.h"

namespace osteomill {

/// What a probe may take for granted about the bone inside the burr.
enum class InsideBurr {
    any,    ///< nothing
    carved  ///< the burr has carved where it is, and there is nothing that it does not cut
};

/// Samples the bone around one burr and its shank, at the burr's patches (burr_patches.h). Allocates when
/// constructed.
class EngagementProbe {
  public:
    explicit EngagementProbe(const Burr& burr, double spacing_mm, const EdgeShares& edge_shares = {},
                             const UncutTissues& uncut = {});

    /// Fills `out` for a burr at `position_mm` with its spindle along `spindle_axis` (unit), which turns at
    /// `speed_share` (positive) of the burr's own speed. The surface of the bone is where the trilinear
    /// fraction crosses one half. Real-time safe.
    void sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                double speed_share, InsideBurr inside, Engagement& out) noexcept;
    /// Likewise at the burr's own speed, with any bone inside.
    void sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                Engagement& out) noexcept {
        sample(bone, position_mm, spindle_axis, 1.0, InsideBurr::any, out);
    }

  private:
    void sample_burr(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                     double speed_share, InsideBurr inside, Engagement& out) noexcept;

    /// Patches are looked at four at a time: a vector that every processor has.
    static constexpr std::size_t four = 4;
    /// Fractions, 0 to 255, of four patches at each of four positions along their normals, from within
    /// outward.
    using FourFractions = std::array<std::array<float, four>, 4>;
    /// Where bone begins: between two such positions, the outer of them in bone.
    struct Crossing {
        bool found = false;
        float offset_voxels = 0.0f;
        float bone_offset_voxels = 0.0f;
    };

    /// Patches `first` to `first` + 3; positions farther out than bone in all four are not set, nor are those
    /// where a carved burr leaves none. `centre` and the bricks in voxels from the bricks' base.
    FourFractions sample_four(std::size_t first, const glm::mat3& frame, const glm::vec3& centre,
                              float radius_voxels, InsideBurr inside) const noexcept;
    static Crossing first_crossing(const FourFractions& along, std::size_t lane);
    /// Whether what begins at a crossing is bone that no burr cuts.
    bool is_uncut(const glm::vec3& surface, const glm::vec3& outward,
                  const Crossing& crossing) const noexcept;

    double radius_mm_;
    bool has_edge_force_;
    EdgeShares edge_shares_;
    UncutTissues uncut_;
    std::vector<BurrPatch> patches_;
    double bounding_radius_mm_;  // of a ball about the head's middle
    double middle_height_mm_ = 0.0;
    bool has_beside_ = false;                    // of a head that is no ball
    std::array<std::vector<float>, 3> normals_;  // of the patches, by axis
    std::array<std::vector<float>, 3> beside_;   // likewise, voxels; empty for a ball
    BrickNeighbourhood bricks_;
    ShankProbe shank_;
};

}  // namespace osteomill
