#include "tests/studies/force/steady_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/studies/force/bone_block.h"

namespace osteomill::study {

namespace {

/// Off the lattice by an odd share of a voxel, as a hand is.
constexpr glm::dvec3 off_the_lattice_mm(0.031, 0.017, 0.023);

double microseconds_of(const auto& work) {
    const auto before = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count();
}

}  // namespace

SteadyPath path_of(const SteadyCase& c, const SteadyRun& run) {
    const double speed = glm::length(c.velocity_mm_per_s);
    const glm::dvec3 direction = c.velocity_mm_per_s / speed;
    const double radius = c.burr.radius_mm();
    SteadyPath path{.step_s = 1.0 / run.milling_rate_hz};
    path.steps =
        std::max(run.min_steps, static_cast<int>(std::lround(run.travel_mm / (speed * path.step_s))));

    const glm::dvec3 offset = off_the_lattice_mm - glm::dot(off_the_lattice_mm, c.up) * c.up;
    path.start_mm = (radius - c.depth_mm) * c.up + offset;
    const double climb = glm::dot(direction, c.up);
    const bool steady_for_good = std::abs(climb) < 1e-9 || (climb < -1.0 + 1e-9 && c.depth_mm >= radius);
    if (!steady_for_good) {
        const double most_mm = std::min(0.5, c.depth_mm / 3.0) / std::abs(climb);
        path.steps = std::max(1, std::min(path.steps, static_cast<int>(most_mm / (speed * path.step_s))));
        path.start_mm -= 0.5 * path.steps * path.step_s * c.velocity_mm_per_s;
    }
    path.end_mm = path.start_mm + path.steps * path.step_s * c.velocity_mm_per_s;
    return path;
}

ForceSeries run_steady(const SteadyCase& c, const SteadyRun& run, const MakeModel& make_model) {
    const SteadyPath path = path_of(c, run);
    const glm::dvec3 direction = glm::normalize(c.velocity_mm_per_s);
    const double margin = c.burr.radius_mm() + 5.0 * run.voxel_mm;
    const BoneBlock block{.low_mm = glm::min(path.start_mm, path.end_mm) - margin,
                          .high_mm = glm::max(path.start_mm, path.end_mm) + margin,
                          .up = c.up};
    const auto model = make_model(voxelised(block, run.voxel_mm), c.burr);
    const auto go = [&](const glm::dvec3& to, bool spindle_on) {
        return model->step(
            {.pose = {to, c.spindle_axis}, .spindle_on = spindle_on, .burr = 0, .elapsed_s = path.step_s});
    };
    if (c.previous_groove_mm_higher) {
        const glm::dvec3 higher = *c.previous_groove_mm_higher * c.up;
        go(path.start_mm + higher - margin * direction, false);
        go(path.end_mm + higher + margin * direction, true);
    }
    go(path.start_mm, false);
    go(path.start_mm, true);

    ForceSeries series{.step_s = path.step_s};
    for (int i = 1; i <= path.steps; ++i) {
        const glm::dvec3 to =
            path.start_mm + (path.end_mm - path.start_mm) * (static_cast<double>(i) / path.steps);
        StepOutcome outcome;
        series.step_us.push_back(microseconds_of([&] { outcome = go(to, true); }));
        series.force_n.push_back(outcome.force_n);
        series.removed_mm3.push_back(outcome.removed_mm3);
    }
    return series;
}

}  // namespace osteomill::study
