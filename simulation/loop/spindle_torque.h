// Torque of a cut on the spindle, from the engagement map.
//
// A patch p of the burr's surface that touches bone and moves toward it cuts f_p, as an edge rubs there and
// takes its chip (Engagement). With r_p its distance from the axis and e_psi along the turn the torque is
//
//     T = sum_p r_p f_p . e_psi
//
// and the spindle's power 2 pi n T. For a head that is no ball, r_p is that of a ball of its diameter.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/scene/burr.h"
#include "simulation/engagement/engagement.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

/// Gaps of freshly carved bone scatter by a tenth of a voxel, so a patch counts as touching up to this gap.
inline constexpr double touching_voxels = 0.2;

/// A patch that cuts while the burr moves with `feed_mm_per_s`.
inline bool cuts(const EngagedPatch& patch, const glm::dvec3& feed_mm_per_s, double spacing_mm) noexcept {
    return glm::dot(patch.normal, feed_mm_per_s) > 0.0 && patch.gap_mm <= touching_voxels * spacing_mm;
}

/// Against the turn, N mm; 0 where nothing cuts. Patient axes. Real-time safe.
double spindle_torque_n_mm(const MillingResult& latest, const Burr& burr,
                           const glm::dvec3& feed_mm_per_s) noexcept;

}  // namespace osteomill
