// The bone just outside the burr, patch by patch: what the burr would cut, or press against, if it moved on.
// The milling loop samples it after each step; couplings solve against it at the haptic rate without touching
// the bone.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/burr.h"
#include "haptic_server/engagement/brick_neighbourhood.h"

namespace osteomill {

/// One patch of the burr's surface that has bone within reach in front of it.
struct EngagedPatch {
    glm::dvec3 normal{0.0};  ///< outward from the burr, patient axes, unit
    double gap_mm = 0.0;  ///< from the burr's surface outward to the bone's; negative where bone lies inside
    /// Milling force on the burr for each mm/s at which the patch advances into bone along its normal, N
    /// s/mm, patient axes:
    /// -(sigma K_t e_psi + K_r n + K_a e_kappa) s dA / (2 pi r n_rev), the law of chip_force.h for a patch
    /// that removes dA times its advance.
    glm::dvec3 cutting_n_s_per_mm{0.0};
    double area_mm2 = 0.0;
};

/// A bounded list of patches around `burr_position_mm`. Empty in free air.
struct Engagement {
    static constexpr std::size_t max_patches = 1024;

    glm::dvec3 burr_position_mm{0.0};  ///< patient LPS; the position for which the gaps hold
    double spacing_mm = 0.1;           ///< of the bone's voxels: gaps are good to about a tenth of it
    std::size_t count = 0;
    std::array<EngagedPatch, max_patches> patches;
};

/// Samples the bone around one burr. Holds the burr's patches, equal in area and spread over the sphere by a
/// Fibonacci lattice, about two voxels apart. Allocates when constructed.
class EngagementProbe {
  public:
    /// Reach of the probe beyond and inside the burr's surface, voxels. Bone farther out is not seen; where
    /// bone lies deeper inside, the gap says no more than this.
    static constexpr double reach_voxels = 1.5;

    EngagementProbe(const Burr& burr, double spacing_mm);

    /// Fills `out` for a burr at `position_mm` with its spindle along `spindle_axis` (unit). The surface of
    /// the bone is where the trilinear fraction crosses one half. Real-time safe.
    void sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                Engagement& out) noexcept;

  private:
    struct Patch {
        glm::dvec3 normal;              ///< burr axes
        glm::dvec3 cutting_n_s_per_mm;  ///< burr axes, for bone of relative stiffness 1
    };

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

    /// Patches `first` to `first` + 3; positions farther out than bone in all four are not set. `centre` and
    /// the bricks in voxels from the bricks' base.
    FourFractions sample_four(std::size_t first, const glm::mat3& frame, const glm::vec3& centre,
                              float radius_voxels) const noexcept;
    static Crossing first_crossing(const FourFractions& along, std::size_t lane);

    double radius_mm_;
    double patch_area_mm2_;
    std::vector<Patch> patches_;
    std::array<std::vector<float>, 3> normals_;  // of the patches, by axis
    BrickNeighbourhood bricks_;
};

}  // namespace osteomill
