// The bone just outside the burr, direction by direction: what the burr would cut, or press against, if it
// moved on. The milling loop samples it after each step; couplings solve against it at the haptic rate
// without touching the bone.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace osteomill {

/// One patch of the burr's surface that has bone within reach in front of it.
struct EngagedPatch {
    glm::dvec3 normal{0.0};  ///< outward from the burr, patient axes, unit
    double gap_mm = 0.0;     ///< from the burr's surface outward to the bone; negative where bone lies inside
    /// Milling force on the burr for each mm of bone that the patch has cut within one second along its
    /// normal: F = -(sigma K_t e_psi + K_r n + K_a e_kappa) s dA / (2 pi r n_rev) * (mm / s). N s/mm, patient
    /// axes.
    glm::dvec3 cutting_n_s_per_mm{0.0};
    double area_mm2 = 0.0;  ///< of the patch, times the share of it that meets bone
};

/// A bounded list of patches around `burr_position_mm`. Empty in free air.
struct Engagement {
    static constexpr std::size_t max_patches = 1024;
    static constexpr double reach_voxels = 2.0;  ///< bone farther out than this is not seen

    glm::dvec3 burr_position_mm{0.0};
    std::size_t count = 0;
    std::array<EngagedPatch, max_patches> patches;
};

}  // namespace osteomill
