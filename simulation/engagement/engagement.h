// Engagement map: the bone just outside the burr, patch by patch, that the burr would cut or press against if
// it moved on. The milling loop samples it after each step (engagement_probe.h); couplings solve against it
// at the haptic rate without touching the bone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "common/scene/burr.h"

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
    /// Force on the burr of edges that rub where the patch cuts, however slowly, N, patient axes:
    /// -(sigma K_te e_psi + K_re n + K_ae e_kappa) s N_phi dA / (2 pi r).
    glm::dvec3 edge_n{0.0};
    double area_mm2 = 0.0;  ///< of the part of it that has bone before it; the forces are that part's, too
    /// Bone that no burr cuts is in front of the patch: it is a wall even with the spindle on, and the forces
    /// above are zero.
    bool is_wall = false;
};

/// One patch of the shank behind the burr that has bone within reach in front of it. Nothing cuts there:
/// bone is a wall to it.
struct ShankPatch {
    glm::dvec3 normal{0.0};  ///< outward from the shank, patient axes, unit
    double gap_mm = 0.0;     ///< as of an EngagedPatch
    double area_mm2 = 0.0;
    glm::dvec3 arm_mm{0.0};  ///< from the burr's centre to the patch, patient axes
};

/// A bounded list of patches around `burr_position_mm`. Empty in free air.
struct Engagement {
    static constexpr std::size_t max_patches = 1024;
    static constexpr std::size_t max_shank_patches = 64;
    /// Reach of the map beyond and inside the burr's surface, voxels. Bone farther out is not seen; if bone
    /// lies deeper inside, the gap is no more than this.
    static constexpr double reach_voxels = 1.5;

    glm::dvec3 burr_position_mm{0.0};  ///< patient LPS; the position for which the gaps hold
    double spacing_mm = 0.1;           ///< of the bone's voxels: gaps are good to about a tenth of it
    bool has_edge_force = false;       ///< of the burr; without, edge_n is zero
    bool has_walls = false;            ///< some patch is one
    std::size_t count = 0;
    std::array<EngagedPatch, max_patches> patches;
    std::size_t shank_count = 0;  ///< 0 for a burr without a shank
    std::array<ShankPatch, max_shank_patches> shank_patches;
};

/// Distance of a patch from the spindle's axis, mm, on a ball of the burr's diameter; `out` is the length of
/// its unit normal across the axis. At the tip a patch is as far from the axis as it is wide.
inline double patch_lever_mm(const Burr& burr, double out) noexcept {
    constexpr double least_lever_share = 0.05;
    return burr.radius_mm() * std::max(least_lever_share, out);
}

/// The relative stiffness s of the bone that a patch cuts, from the force that it takes: the law of
/// EngagedPatch, solved for s. `lever_mm`: the patch's. Not finite for a burr without coefficients.
inline double patch_stiffness(const EngagedPatch& patch, const Burr& burr, double lever_mm) noexcept {
    return glm::length(patch.cutting_n_s_per_mm) * 2.0 * std::numbers::pi * lever_mm *
           burr.spindle_rev_per_s / (glm::length(burr.cutting_coefficients_n_per_mm2) * patch.area_mm2);
}

}  // namespace osteomill
