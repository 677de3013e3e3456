#include "studies/stability/map/region_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "studies/stability/map/map_view.h"
#include "studies/stability/map/method_score.h"

namespace osteomill::study {

namespace {

constexpr double gap_between_rates = 0.5;
constexpr double strip_distance = 0.3;

/// The rates and delays that a map has, and where they are drawn: the fastest rate on top, delays downward.
class Rows {
  public:
    explicit Rows(const WholeMap& map) {
        for (const double rate_hz : map_milling_rates_hz())
            if (has(map, [&](const MapCase& c) { return c.milling_rate_hz == rate_hz; }))
                rates_hz_.push_back(rate_hz);
        for (const int delay_ticks : map_delays_ticks())
            if (has(map, [&](const MapCase& c) { return c.delay_ticks == delay_ticks; }))
                delays_ticks_.push_back(delay_ticks);
    }

    const std::vector<double>& rates_hz() const { return rates_hz_; }
    const std::vector<int>& delays_ticks() const { return delays_ticks_; }

    double y(std::size_t rate, std::size_t delay) const {
        const double delays = static_cast<double>(delays_ticks_.size());
        return static_cast<double>(rate) * (delays + gap_between_rates) + delays - static_cast<double>(delay);
    }

  private:
    static bool has(const WholeMap& map, const std::function<bool(const MapCase&)>& is_wanted) {
        return std::any_of(map.points.begin(), map.points.end(), [&](const MapPoint& point) {
            return point.part == MapPart::map && is_wanted(point.run);
        });
    }

    std::vector<double> rates_hz_;
    std::vector<int> delays_ticks_;
};

/// Values of x that are apart by more than how a run may measure one resistance.
std::vector<double> columns_of(const std::vector<MapResult>& results) {
    constexpr double one_column = 1.03;
    std::vector<double> all;
    for (const MapResult& result : results) all.push_back(result.x());
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
                     [](const MapResult* a, const MapResult* b) { return a->x() < b->x(); });
    std::vector<Run> runs;
    for (const MapResult* result : strip) {
        const auto above = std::upper_bound(edges.begin(), edges.end(), result->x());
        const Run box{*(above - 1), *above, result->outcome.is_stable};
        if (!runs.empty() && runs.back().is_stable == box.is_stable && runs.back().high == box.low)
            runs.back().high = box.high;
        else
            runs.push_back(box);
    }
    return runs;
}

}  // namespace

Table region_table_of(const WholeMap& map, MapScene scene) {
    Table table({"number", "method", "grip", "x_low", "x_high", "y", "stable"});
    const auto in_scene = [&](const MapPoint& point) {
        return point.part == MapPart::map && point.run.scene == scene;
    };
    const std::vector<double> columns = columns_of(results_where(map, in_scene));
    if (columns.empty()) return table;
    const std::vector<double> edges = edges_between(columns);
    const Rows rows(map);
    const auto add_strip = [&](const std::string& method, std::size_t grip, std::size_t rate,
                               std::size_t delay) {
        const auto strip = results_where(map, [&](const MapPoint& point) {
            const MapCase& c = point.run;
            return in_scene(point) && c.method == method && c.grip == map_grips()[grip] &&
                   c.milling_rate_hz == rows.rates_hz()[rate] && c.delay_ticks == rows.delays_ticks()[delay];
        });
        const double y = rows.y(rate, delay) + strip_distance * (1.0 - static_cast<double>(grip));
        for (const Run& run : runs_of(strip, edges))
            table.add({number_of(method), method, grip + 1, run.low, run.high, y, run.is_stable});
    };
    for (const std::string& method : map_methods())
        for (std::size_t grip = 0; grip < map_grips().size(); ++grip)
            for (std::size_t rate = 0; rate < rows.rates_hz().size(); ++rate)
                for (std::size_t delay = 0; delay < rows.delays_ticks().size(); ++delay)
                    add_strip(method, grip, rate, delay);
    return table;
}

Table region_rows_of(const WholeMap& map) {
    const Rows rows(map);
    Table table({"y", "label"});
    for (std::size_t rate = 0; rate < rows.rates_hz().size(); ++rate)
        for (std::size_t delay = 0; delay < rows.delays_ticks().size(); ++delay) {
            const std::string rate_name = delay == 0 ? fmt::format("{:.0f} Hz  ", rows.rates_hz()[rate]) : "";
            table.add({rows.y(rate, delay), fmt::format("{}{}", rate_name, rows.delays_ticks()[delay])});
        }
    return table;
}

}  // namespace osteomill::study
