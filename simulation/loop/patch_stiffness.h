// The relative stiffness of the bone that a patch of the burr's surface cuts, from the force that it takes:
// the law of EngagedPatch, solved for s.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/scene/burr.h"
#include "simulation/engagement/engagement.h"

namespace osteomill {

/// Distance of a patch from the spindle's axis, mm, on a ball of the burr's diameter; `out` is the length of
/// its unit normal across the axis. At the tip a patch is as far from the axis as it is wide.
inline double patch_lever_mm(const Burr& burr, double out) noexcept {
    constexpr double least_lever_share = 0.05;
    return burr.radius_mm() * std::max(least_lever_share, out);
}

/// `lever_mm`: the patch's. Not finite for a burr without coefficients.
inline double patch_stiffness(const EngagedPatch& patch, const Burr& burr, double lever_mm) noexcept {
    return glm::length(patch.cutting_n_s_per_mm) * 2.0 * std::numbers::pi * lever_mm *
           burr.spindle_rev_per_s / (glm::length(burr.cutting_coefficients_n_per_mm2) * patch.area_mm2);
}

}  // namespace osteomill
