#include "tests/studies/force/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

/// By how much a point misses what it must do: 1 is just met.
double over_target(const SurveyResult& r) {
    const double error = r.error / r.point.most_error;
    return r.point.most_ripple ? std::max(error, r.ripple / *r.point.most_ripple) : error;
}

template <typename Value>
std::vector<double> values_of(const std::vector<const SurveyResult*>& results, Value&& value) {
    std::vector<double> values;
    values.reserve(results.size());
    for (const SurveyResult* r : results) values.push_back(value(*r));
    return values;
}

ordered_json group_summary(const std::vector<const SurveyResult*>& results) {
    const auto errors = values_of(results, [](const SurveyResult& r) { return 100.0 * r.error; });
    const auto removal = values_of(results, [](const SurveyResult& r) { return 100.0 * r.removal_error; });
    const auto misses = [&](auto&& meets) {
        return std::count_if(results.begin(), results.end(),
                             [&](const SurveyResult* r) { return !meets(*r); });
    };
    std::vector<const SurveyResult*> promised;
    for (const SurveyResult* r : results)
        if (r->point.most_ripple) promised.push_back(r);
    const auto ripples = values_of(promised, [](const SurveyResult& r) { return 100.0 * r.ripple; });
    return {{"points", results.size()},
            {"miss_error", misses([](const SurveyResult& r) { return r.meets_error(); })},
            {"miss_ripple", misses([](const SurveyResult& r) { return r.meets_ripple(); })},
            {"error_percent", {{"p50", percentile(errors, 0.5)}, {"max", percentile(errors, 1.0)}}},
            {"removal_error_percent", {{"p50", percentile(removal, 0.5)}, {"max", percentile(removal, 1.0)}}},
            {"ripple_percent_5_mm", {{"p50", percentile(ripples, 0.5)}, {"max", percentile(ripples, 1.0)}}}};
}

}  // namespace

SurveyResult measure(const SurveyPoint& point, const MakeModel& make_model) {
    const SteadyMotion motion = motion_of(point.motion);
    const BoneFunction bone = bone_of(point.motion);
    // Nobody promises more of the removal than the force does: half the points will do.
    const double removal = reference_removal_mm3_per_s(motion, bone, {.kappa = 90, .psi = 360});
    const ForceSeries series = run_steady(point.motion, point.run, make_model);
    SurveyResult result{.point = point,
                        .reference_n = mean_reference_force_n(motion, bone),
                        .force_n = mean_force_n(series),
                        .ripple = ripple(series),
                        .step_us = percentile(series.step_us, 0.5)};
    result.error = relative_error(result.force_n, result.reference_n);
    result.removal_error = std::abs(removal_mm3_per_s(series) - removal) / removal;
    return result;
}

std::string csv_of(const std::vector<SurveyResult>& results) {
    std::string csv =
        "group,name,diameter_mm,depth_mm,spindle_tilt_deg,spindle_azimuth_deg,up_x,up_y,up_z,feed_x_mm_s,"
        "feed_y_mm_s,"
        "feed_z_mm_s,rpm,edges,groove_mm_higher,milling_rate_hz,voxel_mm,reference_x_n,reference_y_n,"
        "reference_z_n,"
        "force_x_n,"
        "force_y_n,force_z_n,error_percent,error_target_percent,removal_error_percent,ripple_percent,"
        "ripple_target_percent,step_us\n";
    for (const SurveyResult& r : results) {
        const SteadyCase& c = r.point.motion;
        csv += fmt::format(
            "{},\"{}\",{},{:.4f},{:.2f},{:.2f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.0f},{},{},{:."
            "0f},{},"
            "{:.6f},{:.6f},"
            "{:.6f},{:.6f},{:.6f},{:.6f},{:.4f},{},{:.4f},{:.4f},{},{:.2f}\n",
            r.point.group, c.name, c.burr.diameter_mm, c.depth_mm, r.point.tilt_deg, r.point.azimuth_deg,
            c.up.x, c.up.y, c.up.z, c.velocity_mm_per_s.x, c.velocity_mm_per_s.y, c.velocity_mm_per_s.z,
            60.0 * c.burr.spindle_rev_per_s, c.burr.edges,
            c.previous_groove_mm_higher ? fmt::format("{:.4f}", *c.previous_groove_mm_higher) : "",
            r.point.run.milling_rate_hz, r.point.run.voxel_mm, r.reference_n.x, r.reference_n.y,
            r.reference_n.z, r.force_n.x, r.force_n.y, r.force_n.z, 100.0 * r.error,
            100.0 * r.point.most_error, 100.0 * r.removal_error, 100.0 * r.ripple,
            r.point.most_ripple ? fmt::format("{}", 100.0 * *r.point.most_ripple) : "", r.step_us);
    }
    return csv;
}

ordered_json summary_of(const std::vector<SurveyResult>& results) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<const SurveyResult*>> groups;
    std::vector<const SurveyResult*> all;
    for (const SurveyResult& r : results) {
        if (!groups.contains(r.point.group)) order.push_back(r.point.group);
        groups[r.point.group].push_back(&r);
        all.push_back(&r);
    }
    ordered_json summary;
    summary["all"] = group_summary(all);
    for (const std::string& group : order) summary["groups"][group] = group_summary(groups[group]);

    constexpr std::size_t most_named = 20;
    std::stable_sort(all.begin(), all.end(), [](const SurveyResult* a, const SurveyResult* b) {
        return over_target(*a) > over_target(*b);
    });
    summary["worst"] = ordered_json::array();
    for (const SurveyResult* r : all) {
        if (over_target(*r) <= 1.0 || summary["worst"].size() == most_named) break;
        summary["worst"].push_back({{"group", r->point.group},
                                    {"name", r->point.motion.name},
                                    {"error_percent", 100.0 * r->error},
                                    {"error_target_percent", 100.0 * r->point.most_error},
                                    {"removal_error_percent", 100.0 * r->removal_error},
                                    {"ripple_percent", 100.0 * r->ripple}});
    }
    return summary;
}

}  // namespace osteomill::study
