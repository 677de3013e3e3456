#include "studies/stability/map/map_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "studies/stability/map/implicit_bars.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/map_view.h"
#include "studies/stability/map/method_score.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

bool is_of(const MapPoint& point, MapPart part, const MethodScore& score) {
    return point.part == part && point.run.method == score.method && point.run.scene == score.scene;
}

/// Share that is stable along an axis of the map: an object by value.
template <typename Value, typename ValueOf>
ordered_json shares_by(const WholeMap& map, const MethodScore& score, const std::vector<Value>& axis,
                       ValueOf&& value_of, const std::function<std::string(const Value&)>& name) {
    ordered_json shares = ordered_json::object();
    for (const Value& value : axis) {
        const double share = stable_share(results_where(map, [&](const MapPoint& point) {
            return is_of(point, MapPart::map, score) && value_of(point.run) == value;
        }));
        if (!std::isnan(share)) shares[name(value)] = share;
    }
    return shares;
}

/// The largest resistance (or wall) up to which everything is stable with that grip at 1000 Hz without delay;
/// 0 where not even the least is.
double stable_up_to(const WholeMap& map, const MethodScore& score, MapGrip grip) {
    const auto results = results_where(map, [&](const MapPoint& point) {
        return is_of(point, MapPart::map, score) && point.run.grip == grip &&
               point.run.milling_rate_hz == 1000.0 && point.run.delay_ticks == 0;
    });
    double least_unstable = std::numeric_limits<double>::infinity();
    for (const MapResult& result : results)
        if (!result.outcome.is_stable) least_unstable = std::fmin(least_unstable, result.x());
    double largest = 0.0;
    for (const MapResult& result : results)
        if (result.x() < least_unstable) largest = std::fmax(largest, result.x());
    return largest;
}

ordered_json json_of(const WholeMap& map, const MethodScore& score) {
    ordered_json up_to = ordered_json::object();
    for (const MapGrip grip : map_grips()) up_to[name_of(grip)] = stable_up_to(map, score, grip);
    ordered_json found{
        {"cases", score.cases},
        {"stable", score.stable},
        {"stable_share", score.share()},
        {"by_grip", shares_by<MapGrip>(
                        map, score, map_grips(), [](const MapCase& c) { return c.grip; },
                        [](const MapGrip& grip) { return name_of(grip); })},
        {"by_milling_rate_hz",
         shares_by<double>(
             map, score, map_milling_rates_hz(), [](const MapCase& c) { return c.milling_rate_hz; },
             [](const double& hz) { return fmt::format("{}", hz); })},
        {"by_delay_ticks", shares_by<int>(
                               map, score, map_delays_ticks(), [](const MapCase& c) { return c.delay_ticks; },
                               [](const int& ticks) { return fmt::format("{}", ticks); })},
        {score.scene == MapScene::cutting ? "stable_up_to_n_s_per_m" : "stable_up_to_n_per_mm", up_to},
        {"rms_error_percent",
         {{"median", 100.0 * score.median_rms_error},
          {"worst", 100.0 * score.worst_rms_error},
          {"median_where_all_are_stable", 100.0 * score.common_rms_error}}},
        {"mean_error_percent", {{"median", 100.0 * score.median_mean_error}}}};
    const double on_real_device = stable_share(
        results_where(map, [&](const MapPoint& point) { return is_of(point, MapPart::real_device, score); }));
    if (!std::isnan(on_real_device)) found["stable_share_on_real_device"] = on_real_device;
    return found;
}

}  // namespace

ordered_json summary_of(const WholeMap& map) {
    ordered_json methods = ordered_json::object();
    for (const MapScene scene : {MapScene::cutting, MapScene::wall})
        for (const MethodScore& score : method_scores(map, MapPart::map, scene))
            methods[score.method][name_of(scene)] = json_of(map, score);
    ordered_json bars = ordered_json::array();
    for (const Bar& bar : implicit_bars(map))
        bars.push_back({{"what", bar.what},
                        {"bar", bar.bar},
                        {"worst", bar.worst},
                        {"is_met", bar.is_met()},
                        {"where", bar.where}});
    return {{"cases", map.points.size()},
            {"selection", study::json_of(map.selection)},
            {"methods", methods},
            {"bars", bars}};
}

std::string summary_text_of(const WholeMap& map) {
    const auto percent = [](double share) {
        return std::isnan(share) ? std::string("-") : fmt::format("{:.1f}", 100.0 * share);
    };
    constexpr const char* columns = "{:<31}{:>8}{:>6}{:>9}{:>7}{:>8}{:>6}{:>9}\n";
    std::string text =
        fmt::format(columns, "%", "cutting", "rms", "rms, all", "real", "wall", "rms", "rms, all");
    const auto walls = method_scores(map, MapPart::map, MapScene::wall);
    const auto real = method_scores(map, MapPart::real_device, MapScene::cutting);
    const auto named = [](const std::vector<MethodScore>& scores, const std::string& method) {
        for (const MethodScore& score : scores)
            if (score.method == method) return score;
        const double none = std::numeric_limits<double>::quiet_NaN();
        return MethodScore{.method = method, .median_rms_error = none, .common_rms_error = none};
    };
    for (const MethodScore& score : method_scores(map, MapPart::map, MapScene::cutting)) {
        const MethodScore wall = named(walls, score.method);
        text += fmt::format(columns, score.method, percent(score.share()), percent(score.median_rms_error),
                            percent(score.common_rms_error), percent(named(real, score.method).share()),
                            percent(wall.share()), percent(wall.median_rms_error),
                            percent(wall.common_rms_error));
    }
    text +=
        "cutting, wall: share that is stable; rms: median error there; rms, all: where every method is "
        "stable; real: "
        "share of cutting on a real device\n";
    for (const Bar& bar : implicit_bars(map))
        text += fmt::format("{} {}: {:.3g}, at most {:.3g}{}\n", bar.is_met() ? "met   " : "MISSED", bar.what,
                            bar.worst, bar.bar, bar.where.empty() ? "" : " (" + bar.where + ")");
    return text;
}

}  // namespace osteomill::study
