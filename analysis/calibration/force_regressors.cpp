#include "analysis/calibration/force_regressors.h"

#include <cmath>
#include <numbers>

#include "analysis/calibration/steady_case.h"

namespace osteomill::study {

namespace {

/// A dynamometer is not as true as a coarse sum; a table of 24 runs takes a fraction of a second.
constexpr Quadrature enough{.kappa = 120, .psi = 240};

SteadyCase case_of(const RunSetting& setting) {
    const double tilt = setting.tilt_deg * std::numbers::pi / 180.0;
    const double toward = setting.tilt_direction_deg * std::numbers::pi / 180.0;
    SteadyCase c;
    c.burr.diameter_mm = setting.diameter_mm;
    c.burr.edges = setting.edges;
    c.burr.spindle_rev_per_s = setting.rpm / 60.0;
    c.burr.sense = setting.turns;
    c.velocity_mm_per_s = {setting.feed_mm_per_s, 0.0, 0.0};
    c.spindle_axis = {std::sin(tilt) * std::cos(toward), std::sin(tilt) * std::sin(toward), std::cos(tilt)};
    c.depth_mm = setting.depth_mm;
    c.previous_groove_mm_higher = setting.previous_groove_mm_higher;
    return c;
}

}  // namespace

RunRegressors regressors_of(const RunSetting& setting) {
    SteadyCase c = case_of(setting);
    const BoneFunction bone = bone_of(c);
    RunRegressors regressors;
    for (int column = 0; column < coefficient_count; ++column) {
        glm::dvec3 unit(0.0);
        unit[column % 3] = 1.0;
        c.burr.cutting_coefficients_n_per_mm2 = column < 3 ? unit : glm::dvec3(0.0);
        c.burr.edge_coefficients_n_per_mm = column < 3 ? glm::dvec3(0.0) : unit;
        const glm::dvec3 force_n = mean_reference_force_n(motion_of(c), bone, enough);
        regressors.col(column) << force_n.x, force_n.y, force_n.z;
    }
    return regressors;
}

RunRegressors at_other_feed(const RunRegressors& geometry, const RunSetting& from, double feed_mm_per_s,
                            double rpm) {
    RunRegressors regressors = geometry;
    regressors.leftCols<3>() *= (feed_mm_per_s / rpm) / (from.feed_mm_per_s / from.rpm);
    return regressors;
}

}  // namespace osteomill::study
