#include "studies/stability/map/implicit_bars.h"

#include <cmath>
#include <functional>
#include <limits>

#include "simulation/device/haptic_device.h"
#include "studies/stability/map/map_points.h"
#include "studies/stability/map/map_text.h"
#include "studies/stability/map/map_view.h"

namespace osteomill::study {

namespace {

constexpr double most_unstable_percent = 0.0;
constexpr double most_rms_error_percent = 3.0;
constexpr double most_mean_error_percent = 2.0;
constexpr double most_jump_n = 0.3;
constexpr double most_rate_dependence_percent = 2.0;
constexpr double most_residual_n = 1e-3;

/// The largest of a number over results; results of which it is NaN are passed over.
Bar worst_of(const std::string& what, double bar, const std::vector<MapResult>& results,
             const std::function<double(const MapResult&)>& number) {
    Bar found{.what = what, .bar = bar, .worst = std::numeric_limits<double>::quiet_NaN()};
    for (const MapResult& result : results) {
        const double value = number(result);
        if (std::isnan(value) || value <= found.worst) continue;
        found.worst = value;
        found.where = text_of(result.point.run);
    }
    return found;
}

/// NaN where there are none.
Bar unstable_among(const std::string& what, const std::vector<MapResult>& results) {
    Bar unstable = worst_of(what, most_unstable_percent, results,
                            [](const MapResult& r) { return r.outcome.is_stable ? 0.0 : 1.0; });
    if (results.empty()) return unstable;
    if (unstable.worst == 0.0) unstable.where.clear();
    unstable.worst = 100.0 * (1.0 - stable_share(results));
    return unstable;
}

/// By how much the bone carved at 100 Hz differs from that at 1000 Hz; NaN for a result that is not at 100
/// Hz.
double rate_dependence_percent(const MapResult& slow, const std::vector<MapResult>& results) {
    MapCase wanted = slow.point.run;
    if (wanted.milling_rate_hz != 100.0) return std::numeric_limits<double>::quiet_NaN();
    wanted.milling_rate_hz = 1000.0;
    for (const MapResult& fast : results)
        if (fast.point.run == wanted && fast.outcome.removed_mm3 > 0.0)
            return 100.0 * std::abs(slow.outcome.removed_mm3 / fast.outcome.removed_mm3 - 1.0);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<Bar> implicit_bars(const WholeMap& map) {
    const auto within = [&](MapScene scene, bool is_ideal_device) {
        return results_where(map, [=](const MapPoint& point) {
            return point.run.method == map_methods().front() && point.run.scene == scene &&
                   point.run.is_ideal_device == is_ideal_device &&
                   point.run.delay_ticks <= most_promised_delay_ticks;
        });
    };
    if (results_where(map, [](const MapPoint& point) { return point.part == MapPart::bars; }).empty())
        return {};
    const auto all = within(MapScene::cutting, true);
    const auto all_scenes = results_where(map, [](const MapPoint& point) {
        return point.run.method == map_methods().front() &&
               point.run.delay_ticks <= most_promised_delay_ticks;
    });
    const double only_stable = std::numeric_limits<double>::quiet_NaN();
    return {
        unstable_among("cutting that is unstable, %", all),
        worst_of("rms error of the force, % of its mean", most_rms_error_percent, all,
                 [&](const MapResult& r) {
                     return r.outcome.is_stable ? 100.0 * rms_error(r.outcome) : only_stable;
                 }),
        worst_of("error of the mean force, %", most_mean_error_percent, all,
                 [&](const MapResult& r) {
                     return r.outcome.is_stable ? 100.0 * mean_error(r.outcome) : only_stable;
                 }),
        worst_of("largest force, N", DeviceLimits{}.max_force_n, all,
                 [](const MapResult& r) { return r.outcome.peak_n; }),
        worst_of("largest jump between ticks, N", most_jump_n, all,
                 [](const MapResult& r) { return r.outcome.largest_jump_n; }),
        worst_of("bone carved, 100 Hz against 1000 Hz, %", most_rate_dependence_percent, all,
                 [&](const MapResult& r) { return rate_dependence_percent(r, all); }),
        unstable_among("walls that are unstable, %", within(MapScene::wall, true)),
        worst_of("largest jump between ticks, cutting on a real device, N", most_jump_n,
                 within(MapScene::cutting, false),
                 [](const MapResult& r) { return r.outcome.largest_jump_n; }),
        worst_of("force that a contact solve left over, N", most_residual_n, all_scenes,
                 [](const MapResult& r) { return r.outcome.max_residual_n; }),
        worst_of("ticks without a balance on the spring alone", 0.0, all_scenes,
                 [](const MapResult& r) { return r.outcome.fallbacks; }),
        worst_of("forces turned off for their energy", 0.0, all_scenes,
                 [](const MapResult& r) { return r.outcome.energy_faults; }),
    };
}

}  // namespace osteomill::study
