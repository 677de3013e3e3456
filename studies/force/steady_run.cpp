#include "studies/force/steady_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "common/scene/burr_profile.h"
#include "studies/force/bone_block.h"
#include "studies/force/path_run.h"

namespace osteomill::study {

namespace {

/// Off the lattice by an odd share of a voxel, as a hand is.
constexpr glm::dvec3 off_the_lattice_mm(0.031, 0.017, 0.023);

}  // namespace

SteadyPath path_of(const SteadyCase& c, const SteadyRun& run) {
    const double speed = glm::length(c.velocity_mm_per_s);
    const glm::dvec3 direction = c.velocity_mm_per_s / speed;
    const double radius = c.burr.radius_mm();
    SteadyPath path{.step_s = 1.0 / run.milling_rate_hz};
    path.steps =
        std::max(run.min_steps, static_cast<int>(std::lround(run.travel_mm / (speed * path.step_s))));

    const glm::dvec3 offset = off_the_lattice_mm - glm::dot(off_the_lattice_mm, c.up) * c.up;
    path.start_mm = (above_lowest_mm(c) - c.depth_mm + run.surface_voxels * run.voxel_mm) * c.up + offset;
    const double climb = glm::dot(direction, c.up);
    const bool steady_for_good = std::abs(climb) < 1e-9 || (climb < -1.0 + 1e-9 && c.depth_mm >= radius);
    if (!steady_for_good) {
        const double most_mm = std::min(0.5, c.depth_mm / 3.0) / std::abs(climb);
        const double least_mm = std::min(run.least_dive_voxels * run.voxel_mm, c.depth_mm);
        const double step_mm = speed * path.step_s;
        path.steps = std::max({1, static_cast<int>(std::ceil(least_mm / step_mm)),
                               std::min(path.steps, static_cast<int>(most_mm / step_mm))});
        path.start_mm -= 0.5 * path.steps * path.step_s * c.velocity_mm_per_s;
    }
    path.end_mm = path.start_mm + path.steps * path.step_s * c.velocity_mm_per_s;
    return path;
}

ForceSeries run_steady(const SteadyCase& c, const SteadyRun& run, const MakeModel& make_model) {
    const SteadyPath path = path_of(c, run);
    const glm::dvec3 direction = glm::normalize(c.velocity_mm_per_s);
    double reach = c.burr.radius_mm();
    if (!c.burr.is_ball()) {
        const BurrProfile head(c.burr.head, c.burr.diameter_mm);
        reach += std::max(-head.tip_height(), head.top_height());
    }
    const double margin = reach + 5.0 * run.voxel_mm;
    const BoneBlock block{.low_mm = glm::min(path.start_mm, path.end_mm) - margin,
                          .high_mm = glm::max(path.start_mm, path.end_mm) + margin,
                          .up = c.up,
                          .surface_mm = run.surface_voxels * run.voxel_mm,
                          .is_milled = run.is_milled};
    const auto model = make_model(voxelised(block, run.voxel_mm), c.burr);
    if (c.previous_groove_mm_higher) {
        const glm::dvec3 higher = *c.previous_groove_mm_higher * c.up;
        const std::array groove{path.start_mm + higher - margin * direction,
                                path.end_mm + higher + margin * direction};
        run_path(*model, c.spindle_axis, path.step_s, groove);
    }
    std::vector<glm::dvec3> positions{path.start_mm};
    for (int i = 1; i <= path.steps; ++i)
        positions.push_back(path.start_mm +
                            (path.end_mm - path.start_mm) * (static_cast<double>(i) / path.steps));
    return run_path(*model, c.spindle_axis, path.step_s, positions);
}

}  // namespace osteomill::study
