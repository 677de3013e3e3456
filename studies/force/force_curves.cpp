#include "studies/force/force_curves.h"

#include <fmt/format.h>

namespace osteomill::study {

namespace {

SteadyCase slot() {
    return {.burr = {.diameter_mm = 5.0, .sense = SpindleSense::counter_clockwise},
            .velocity_mm_per_s = {6.0, 0.0, 0.0},
            .depth_mm = 1.0};
}

template <typename Vary>
std::vector<CurveCase> curve(const char* variable, const std::vector<double>& values, Vary&& vary) {
    std::vector<CurveCase> cases;
    for (const double value : values) {
        SteadyCase motion = slot();
        motion.name = fmt::format("{} {}", variable, value);
        vary(motion, value);
        cases.push_back({value, motion});
    }
    return cases;
}

}  // namespace

std::vector<CurveCase> depth_curve() {
    return curve("depth in mm",
                 {0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0},
                 [](SteadyCase& c, double depth_mm) { c.depth_mm = depth_mm; });
}

std::vector<CurveCase> feed_curve() {
    return curve("feed in mm/s", {0.5, 1.0, 2.0, 4.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0},
                 [](SteadyCase& c, double feed_mm_per_s) { c.velocity_mm_per_s = {feed_mm_per_s, 0.0, 0.0}; });
}

std::vector<CurveCase> rpm_curve() {
    return curve("thousand rpm", {10, 15, 20, 30, 40, 50, 60, 70, 80}, [](SteadyCase& c, double thousand_rpm) {
        c.burr.spindle_rev_per_s = 1000.0 * thousand_rpm / 60.0;
    });
}

CurvePoint measure(const CurveCase& c, bool quick) {
    const SteadyRun run{.travel_mm = quick ? 0.6 : 2.0, .min_steps = 10};
    return {.at = c.at,
            .reference_n = mean_reference_force_n(motion_of(c.motion), bone_of(c.motion)),
            .voxels_n = mean_force_n(run_steady(c.motion, run, voxel_model())),
            .bins_n = mean_force_n(
                run_steady(c.motion, run, voxel_model({.summation = ForceSummation::bins})))};
}

Table table_of(const std::vector<CurvePoint>& curve, const std::string& variable) {
    Table table({variable, "reference_x_n", "reference_y_n", "reference_z_n", "voxels_x_n", "voxels_y_n",
                 "voxels_z_n", "bins_x_n", "bins_y_n", "bins_z_n"});
    for (const CurvePoint& p : curve)
        table.add({p.at, p.reference_n.x, p.reference_n.y, p.reference_n.z, p.voxels_n.x, p.voxels_n.y,
                   p.voxels_n.z, p.bins_n.x, p.bins_n.y, p.bins_n.z});
    return table;
}

}  // namespace osteomill::study
