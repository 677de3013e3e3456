#include "tests/studies/stability/map/region_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/studies/stability/map/map_view.h"
#include "tests/studies/stability/map/method_score.h"

namespace osteomill::study {

namespace {

constexpr double gap_between_rates = 0.5;
constexpr double strip_distance = 0.3;

/// Of the row in which a rate and a delay are drawn: the fastest rate on top, delays downward.
double row_y(std::size_t rate, std::size_t delay) {
    const double delays = static_cast<double>(map_delays_ticks().size());
    return static_cast<double>(rate) * (delays + gap_between_rates) + delays - static_cast<double>(delay);
}

double x_of(const MapResult& result) {
    return result.point.run.scene == MapScene::cutting ? result.outcome.resistance_n_s_per_m
                                                       : result.point.run.wall_n_per_mm;
}

/// Values of x that are apart by more than how a run may measure one resistance.
std::vector<double> columns_of(const std::vector<MapResult>& results) {
    constexpr double one_column = 1.03;
    std::vector<double> all;
    for (const MapResult& result : results) all.push_back(x_of(result));
    std::sort(all.begin(), all.end());
    std::vector<double> columns;
    for (const double x : all)
        if (columns.empty() || x > one_column * columns.back()) columns.push_back(x);
    return columns;
}

/// Neighbouring boxes that are alike.
struct Run {
    double low;
    double high;
    bool is_stable;
};

/// Boxes meet halfway between columns; the outermost are as wide as the step beside them.
std::vector<double> edges_between(const std::vector<double>& columns) {
    constexpr double lone_column = 1.4;
    const double first = columns.size() > 1 ? std::sqrt(columns[1] / columns[0]) : lone_column;
    const double last =
        columns.size() > 1 ? std::sqrt(columns.back() / columns[columns.size() - 2]) : lone_column;
    std::vector<double> edges{columns.front() / first};
    for (std::size_t i = 1; i < columns.size(); ++i) edges.push_back(std::sqrt(columns[i - 1] * columns[i]));
    edges.push_back(columns.back() * last);
    return edges;
}

/// Of results that differ in x alone.
std::vector<Run> runs_of(const std::vector<MapResult>& results, const std::vector<double>& edges) {
    std::vector<const MapResult*> strip;
    for (const MapResult& result : results) strip.push_back(&result);
    std::stable_sort(strip.begin(), strip.end(),
                     [](const MapResult* a, const MapResult* b) { return x_of(*a) < x_of(*b); });
    std::vector<Run> runs;
    for (const MapResult* result : strip) {
        const auto above = std::upper_bound(edges.begin(), edges.end(), x_of(*result));
        const Run box{*(above - 1), *above, result->outcome.is_stable};
        if (!runs.empty() && runs.back().is_stable == box.is_stable && runs.back().high == box.low)
            runs.back().high = box.high;
        else
            runs.push_back(box);
    }
    return runs;
}

/// The place of a line of a panel: all cases that differ in x alone.
struct Strip {
    const std::string& method;
    std::size_t grip;
    std::size_t rate;
    std::size_t delay;

    bool has(const MapCase& c) const {
        return c.method == method && c.grip == map_grips()[grip] &&
               c.milling_rate_hz == map_milling_rates_hz()[rate] &&
               c.delay_ticks == map_delays_ticks()[delay];
    }
    double y() const { return row_y(rate, delay) + strip_distance * (1.0 - static_cast<double>(grip)); }
};

}  // namespace

std::string region_csv_of(const WholeMap& map, MapScene scene) {
    std::string csv = "number,method,grip,x_low,x_high,y,stable\n";
    const auto in_scene = [&](const MapPoint& point) {
        return point.part == MapPart::map && point.run.scene == scene;
    };
    const std::vector<double> columns = columns_of(results_where(map, in_scene));
    if (columns.empty()) return csv;
    const std::vector<double> edges = edges_between(columns);
    for (const std::string& method : map_methods())
        for (std::size_t grip = 0; grip < map_grips().size(); ++grip)
            for (std::size_t rate = 0; rate < map_milling_rates_hz().size(); ++rate)
                for (std::size_t delay = 0; delay < map_delays_ticks().size(); ++delay) {
                    const Strip strip{method, grip, rate, delay};
                    const auto results = results_where(
                        map, [&](const MapPoint& point) { return in_scene(point) && strip.has(point.run); });
                    for (const Run& run : runs_of(results, edges))
                        csv += fmt::format("{},{},{},{:.5g},{:.5g},{:.2f},{}\n", number_of(method), method,
                                           grip + 1, run.low, run.high, strip.y(), run.is_stable ? 1 : 0);
                }
    return csv;
}

std::string region_rows_csv() {
    std::string csv = "y,label\n";
    for (std::size_t rate = 0; rate < map_milling_rates_hz().size(); ++rate)
        for (std::size_t delay = 0; delay < map_delays_ticks().size(); ++delay)
            csv += delay == 0 ? fmt::format("{},{:.0f} Hz  {}\n", row_y(rate, delay),
                                            map_milling_rates_hz()[rate], map_delays_ticks()[delay])
                              : fmt::format("{},{}\n", row_y(rate, delay), map_delays_ticks()[delay]);
    return csv;
}

}  // namespace osteomill::study
