// Runs the milling model through a steady motion of the reference and averages what it reports.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptic_server/milling/milling_model.h"
#include "tests/support/block.h"
#include "tests/support/reference_cases.h"

namespace osteomill::testing {

struct SteadyResult {
    glm::dvec3 mean_force_n{0.0};
    double removal_mm3_per_s = 0.0;
};

/// The burr enters the block, then travels `travel_mm` in steps of `step_s`; means over that travel.
inline SteadyResult run_steady(const ReferenceCase& c, double spacing_mm, double step_s, double travel_mm,
                               const MillingSettings& settings = {}) {
    const double r = c.burr.radius_mm();
    const double margin = r + 5.0 * spacing_mm;
    const glm::dvec3 direction = glm::normalize(c.velocity_mm_per_s);
    // Off the lattice by an odd share of a voxel, as a hand is.
    const glm::dvec3 start(0.031, 0.017, r - c.depth_mm);
    // Whole steps, so that feed is exact.
    const double speed = glm::length(c.velocity_mm_per_s);
    const auto steps = static_cast<int>(std::lround(travel_mm / (speed * step_s)));
    const glm::dvec3 end = start + steps * step_s * c.velocity_mm_per_s;
    const auto snap = [&](double v) { return std::round(v / spacing_mm) * spacing_mm; };
    glm::dvec3 low = glm::min(start, end) - margin;
    glm::dvec3 high = glm::max(start, end) + margin;
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = snap(low[axis]);
        high[axis] = snap(high[axis]);
    }
    high.z = 0.0;

    MillingModel model(make_block(low, high, spacing_mm), {c.burr}, {}, settings);
    NoEdits edits;
    MillingResult result;
    const auto go = [&](const glm::dvec3& to, bool spindle_on) {
        model.step({.pose = {to, c.spindle_axis}, .spindle_on = spindle_on, .burr = 0, .elapsed_s = step_s},
                   0.0, edits, result);
    };
    if (c.previous_groove_mm_higher) {
        const glm::dvec3 up(0.0, 0.0, *c.previous_groove_mm_higher);
        go(start + up - margin * direction, false);
        go(end + up + margin * direction, true);
    }
    go(start, false);
    go(start, true);

    SteadyResult mean;
    for (int i = 1; i <= steps; ++i) {
        go(start + (end - start) * (static_cast<double>(i) / steps), true);
        mean.mean_force_n += result.force_n / static_cast<double>(steps);
        mean.removal_mm3_per_s += result.removed_mm3 / (steps * step_s);
    }
    return mean;
}

inline double relative_error(const glm::dvec3& value, const glm::dvec3& reference) {
    return glm::length(value - reference) / glm::length(reference);
}

}  // namespace osteomill::testing
