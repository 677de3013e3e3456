#include "studies/stability/map/method_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/output/label_places.h"
#include "common/statistics/percentile.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/map_view.h"

namespace osteomill::study {

namespace {

/// Errors below this share are drawn at it: a logarithmic axis has no zero.
constexpr double smallest_drawn_percent = 0.01;

/// Of the finite values; NaN of none.
double median(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values.empty() ? no_share : percentile(std::move(values), 0.5);
}

/// A case as all methods have it.
std::string without_method(const MapCase& c) {
    MapCase any = c;
    any.method.clear();
    return text_of(any);
}

/// Cases that one method or another does not hold.
std::set<std::string> unstable_somewhere(const std::vector<MapResult>& results) {
    std::set<std::string> unstable;
    for (const MapResult& result : results)
        if (!result.outcome.is_stable) unstable.insert(without_method(result.point.run));
    return unstable;
}

MethodScore score_of(const std::string& method, MapScene scene, const std::vector<MapResult>& results,
                     const std::set<std::string>& unstable) {
    MethodScore score{.method = method, .scene = scene, .cases = results.size()};
    std::vector<double> common_errors;
    std::vector<double> rms_errors;
    std::vector<double> mean_errors;
    for (const MapResult& result : results) {
        if (!result.outcome.is_stable) continue;
        ++score.stable;
        rms_errors.push_back(rms_error(result.outcome));
        mean_errors.push_back(mean_error(result.outcome));
        if (!unstable.contains(without_method(result.point.run))) common_errors.push_back(rms_errors.back());
    }
    score.median_rms_error = median(rms_errors);
    score.median_mean_error = median(mean_errors);
    score.common_rms_error = median(common_errors);
    score.worst_rms_error = no_share;
    for (const double error : rms_errors) score.worst_rms_error = std::fmax(score.worst_rms_error, error);
    return score;
}

double drawn_percent(const MethodScore& score) {
    return std::max(100.0 * score.median_rms_error, smallest_drawn_percent);
}

struct LabelColumn {
    std::vector<double> places;
    double axis_low = -1.0;  ///< decades; what is left of an axis without a point
    double axis_high = 2.0;
};

/// Places of the labels, as far apart as they need on an axis that shows all of them and all points.
LabelColumn label_column(const std::vector<double>& decades) {
    constexpr double lines_an_axis = 20.0;
    constexpr double margin_decades = 0.1;
    constexpr double shortest_axis_decades = 1.2;
    LabelColumn column{.places = decades};
    if (decades.empty()) return column;
    // Labels that spread make the axis longer, which is what spreads them: this has settled after a few
    // rounds.
    for (int round = 0; round < 10; ++round) {
        const auto [lowest_point, highest_point] = std::minmax_element(decades.begin(), decades.end());
        const auto [lowest, highest] = std::minmax_element(column.places.begin(), column.places.end());
        column.axis_low = std::min(*lowest_point, *lowest) - margin_decades;
        column.axis_high = std::max(*highest_point, *highest) + margin_decades;
        const double missing = std::max(0.0, shortest_axis_decades - (column.axis_high - column.axis_low));
        column.axis_low -= 0.5 * missing;
        column.axis_high += 0.5 * missing;
        column.places = label_places(decades, (column.axis_high - column.axis_low) / lines_an_axis);
    }
    return column;
}

}  // namespace

std::vector<MethodScore> method_scores(const WholeMap& map, MapPart part, MapScene scene) {
    const auto in_scene = [&](const MapPoint& point) {
        return point.part == part && point.run.scene == scene;
    };
    const std::set<std::string> unstable = unstable_somewhere(results_where(map, in_scene));
    std::vector<MethodScore> scores;
    for (const std::string& method : map_methods()) {
        const auto results = results_where(
            map, [&](const MapPoint& point) { return in_scene(point) && point.run.method == method; });
        if (!results.empty()) scores.push_back(score_of(method, scene, results, unstable));
    }
    return scores;
}

Table pareto_table_of(const std::vector<MethodScore>& scores) {
    std::vector<double> decades;
    for (const MethodScore& score : scores)
        if (std::isfinite(score.median_rms_error)) decades.push_back(std::log10(drawn_percent(score)));
    const LabelColumn labels = label_column(decades);
    Table table({"number", "method", "axis_low_decades", "axis_high_decades", "stable_percent",
                 "rms_error_percent", "label_decades"});
    auto label = labels.places.begin();
    for (const MethodScore& score : scores) {
        std::vector<nlohmann::ordered_json> row{
            number_of(score.method), score.method, labels.axis_low, labels.axis_high,
            100.0 * score.share(),   nullptr,      nullptr};
        if (std::isfinite(score.median_rms_error)) {
            row[5] = drawn_percent(score);
            row[6] = *label++;
        }
        table.add(std::move(row));
    }
    return table;
}

std::size_t number_of(const std::string& method) {
    const auto& methods = map_methods();
    return static_cast<std::size_t>(std::find(methods.begin(), methods.end(), method) - methods.begin()) + 1;
}

}  // namespace osteomill::study
