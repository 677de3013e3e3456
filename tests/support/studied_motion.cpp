#include "tests/support/studied_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "simulation/cutting_force/reference_force.h"
#include "studies/force/path_run.h"

namespace osteomill::study {

namespace {

BoneFunction flat_bone_with(const std::optional<TopLayer>& layer) {
    if (!layer) return flat_bone();
    return [top = *layer](const glm::dvec3& p) {
        if (p.z > 0.0) return 0.0;
        return -p.z < top.thickness_mm ? top.stiffness : 1.0;
    };
}

/// Mean of the quasi-steady force over the motion, midpoint rule over time.
glm::dvec3 mean_reference_n(const StudiedMotion& motion, int instants) {
    const BoneFunction bone = flat_bone_with(motion.layer);
    const double dt = motion.duration_s / instants;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < instants; ++i) {
        const double t = (i + 0.5) * dt;
        const double apart_s = 1e-4 * motion.duration_s;
        const glm::dvec3 velocity =
            (motion.position_mm(t + apart_s) - motion.position_mm(t - apart_s)) / (2.0 * apart_s);
        sum += mean_reference_force_n({.burr = motion.burr,
                                       .position_mm = motion.position_mm(t),
                                       .spindle_axis = motion.spindle_axis,
                                       .velocity_mm_per_s = velocity},
                                      bone);
    }
    return sum / static_cast<double>(instants);
}

std::function<glm::dvec3(double)> straight(const glm::dvec3& start_mm, const glm::dvec3& velocity_mm_per_s) {
    return [=](double time_s) { return start_mm + time_s * velocity_mm_per_s; };
}

}  // namespace

std::vector<StudiedMotion> studied_motions(bool quick) {
    const Burr burr{.diameter_mm = 5.0, .sense = SpindleSense::counter_clockwise};
    const double radius_mm = burr.radius_mm();
    const double feed_mm_per_s = 6.0;
    const double travel_mm = quick ? 1.2 : 2.4;
    const double duration_s = travel_mm / feed_mm_per_s;
    const glm::dvec3 ahead(feed_mm_per_s, 0.0, 0.0);
    const auto deep = [&](double depth_mm) { return glm::dvec3(0.0, 0.0, radius_mm - depth_mm); };
    // An eighth of a turn or more around a pillar wider than the burr.
    const double arc_radius_mm = 3.0;
    const double turn_rad_per_s = feed_mm_per_s / arc_radius_mm;
    const auto arc = [=](double time_s) {
        const double angle = turn_rad_per_s * time_s;
        return glm::dvec3(arc_radius_mm * std::sin(angle), arc_radius_mm * (1.0 - std::cos(angle)),
                          radius_mm - 1.0);
    };
    const double root_half = std::numbers::sqrt2 / 2.0;

    std::vector<StudiedMotion> motions{
        {.name = "polishing",
         .burr = burr,
         .position_mm = straight(deep(1.0), ahead),
         .duration_s = duration_s},
        {.name = "tilted",
         .burr = burr,
         .spindle_axis = {0.0, root_half, root_half},
         .position_mm = straight(deep(1.5), ahead),
         .duration_s = duration_s},
        {.name = "plunging",
         .burr = burr,
         .position_mm = straight(deep(2.5), {0.0, 0.0, -2.0}),
         .duration_s = 0.5 * travel_mm / 2.0},
        {.name = "curved", .burr = burr, .position_mm = arc, .duration_s = duration_s},
        {.name = "two layers",
         .burr = burr,
         .position_mm = straight(deep(1.5), ahead),
         .duration_s = duration_s,
         .layer = TopLayer{.thickness_mm = 0.8, .stiffness = 0.4}},
    };
    // Only the curved one changes with time, and smoothly.
    for (StudiedMotion& motion : motions)
        motion.reference_n = mean_reference_n(motion, motion.name == "curved" ? 8 : 1);
    return motions;
}

ForceSeries run_motion(const StudiedMotion& motion, const Discretisation& discretisation,
                       const MakeModel& make_model) {
    const double step_s = 1.0 / discretisation.milling_rate_hz;
    const auto steps = static_cast<int>(std::lround(motion.duration_s / step_s));
    std::vector<glm::dvec3> positions;
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    const auto run_in_steps = static_cast<std::size_t>(std::lround(discretisation.run_in_s / step_s));
    for (int i = -static_cast<int>(run_in_steps); i <= steps; ++i) {
        positions.push_back(motion.position_mm(i * step_s) + discretisation.lattice_shift_mm);
        low = glm::min(low, positions.back());
        high = glm::max(high, positions.back());
    }
    const double margin = motion.burr.radius_mm() + 5.0 * discretisation.voxel_mm;
    const BoneBlock block{.low_mm = low - margin, .high_mm = high + margin, .layer = motion.layer};
    const auto model = make_model(voxelised(block, discretisation.voxel_mm), motion.burr);
    const std::span<const glm::dvec3> all(positions);
    if (run_in_steps > 0) run_path(*model, motion.spindle_axis, step_s, all.first(run_in_steps + 1));
    return run_path(*model, motion.spindle_axis, step_s, all.subspan(run_in_steps));
}

}  // namespace osteomill::study
