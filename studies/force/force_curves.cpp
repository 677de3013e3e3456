#include "studies/force/force_curves.h"

namespace osteomill::study {

namespace {

SteadyCase slot() {
    return {.burr = {.diameter_mm = 5.0, .sense = SpindleSense::counter_clockwise},
            .velocity_mm_per_s = {6.0, 0.0, 0.0},
            .depth_mm = 1.0};
}

CurvePoint point_of(double at, const SteadyCase& c, const SteadyRun& run) {
    return {.at = at,
            .reference_n = mean_reference_force_n(motion_of(c), bone_of(c)),
            .voxels_n = mean_force_n(run_steady(c, run, voxel_model())),
            .bins_n = mean_force_n(run_steady(c, run, voxel_model({.summation = ForceSummation::bins})))};
}

}  // namespace

ForceCurves measure_curves(bool quick, const ReportProgress& progress) {
    const SteadyRun run{.travel_mm = quick ? 0.6 : 2.0, .min_steps = 10};
    const std::vector depths_mm{0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0};
    const std::vector feeds_mm_per_s{0.5, 1.0, 2.0, 4.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0};
    const std::vector speeds_rpm{10e3, 15e3, 20e3, 30e3, 40e3, 50e3, 60e3, 70e3, 80e3};
    const double all = static_cast<double>(depths_mm.size() + feeds_mm_per_s.size() + speeds_rpm.size());
    double done = 0.0;
    ForceCurves curves;
    const auto add = [&](std::vector<CurvePoint>& curve, double at, const SteadyCase& c) {
        curve.push_back(point_of(at, c, run));
        progress(++done / all);
    };
    for (const double depth_mm : depths_mm) {
        SteadyCase c = slot();
        c.depth_mm = depth_mm;
        add(curves.depth, depth_mm, c);
    }
    for (const double feed : feeds_mm_per_s) {
        SteadyCase c = slot();
        c.velocity_mm_per_s = {feed, 0.0, 0.0};
        add(curves.feed, feed, c);
    }
    for (const double rpm : speeds_rpm) {
        SteadyCase c = slot();
        c.burr.spindle_rev_per_s = rpm / 60.0;
        add(curves.rpm, rpm / 1000.0, c);
    }
    return curves;
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
