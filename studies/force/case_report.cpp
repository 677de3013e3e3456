#include "studies/force/case_report.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/statistics/percentile.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

ordered_json force_and_removal(const glm::dvec3& force_n, double removal_mm3_per_s) {
    return {{"mean_force_N", {force_n.x, force_n.y, force_n.z}}, {"removal_mm3_s", removal_mm3_per_s}};
}

/// JSON knows no infinity.
ordered_json percent(double share) {
    return std::isfinite(share) ? ordered_json(100.0 * share) : ordered_json(nullptr);
}

double removal_error(double value, double reference) {
    return relative_error(glm::dvec3(value, 0.0, 0.0), glm::dvec3(reference, 0.0, 0.0));
}

}  // namespace

ordered_json report_of(const SteadyCase& c, const SteadyRun& run, const MakeModel& make_model) {
    const SteadyMotion motion = motion_of(c);
    const BoneFunction bone = bone_of(c);
    const glm::dvec3 reference_n = mean_reference_force_n(motion, bone);
    const double reference_mm3_per_s = reference_removal_mm3_per_s(motion, bone);
    const ForceSeries series = run_steady(c, run, make_model);
    const glm::dvec3 force_n = mean_force_n(series);
    const double removal = removal_mm3_per_s(series);
    const SteadyPath path = path_of(c, run);
    return {
        {"name", c.name},
        {"voxel_model", force_and_removal(force_n, removal)},
        {"reference", force_and_removal(reference_n, reference_mm3_per_s)},
        {"file", force_and_removal(c.mean_force_n, c.removal_mm3_per_s)},
        {"error_percent", percent(relative_error(force_n, reference_n))},
        {"file_error_percent", percent(relative_error(force_n, c.mean_force_n))},
        {"removal_error_percent", percent(removal_error(removal, reference_mm3_per_s))},
        {"ripple_percent", percent(ripple(series))},
        {"step_us", {{"p50", percentile(series.step_us, 0.5)}, {"p99", percentile(series.step_us, 0.99)}}},
        {"steps", path.steps},
        {"travel_mm", glm::length(path.end_mm - path.start_mm)},
        {"voxel_mm", run.voxel_mm},
        {"milling_rate_hz", run.milling_rate_hz},
    };
}

}  // namespace osteomill::study
