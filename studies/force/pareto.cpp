#include "studies/force/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/statistics/percentile.h"
#include "studies/force/full_scan.h"

namespace osteomill::study {

namespace {

std::string millimetres(double voxel_mm) {
    return fmt::format("{} mm", voxel_mm);
}

/// Where the lattice lies relative to the motion, mm. The bone's surface stays on faces of voxels.
constexpr std::array lattice_shifts_mm{glm::dvec3(0.031, 0.017, 0.0), glm::dvec3(0.077, 0.043, 0.0),
                                       glm::dvec3(0.003, 0.091, 0.0)};

/// Thirty tooth periods: e^-30 of what a burr that was put into solid bone removed at once.
constexpr double tooth_periods_to_forget_s = 0.03;

}  // namespace

std::vector<ParetoSetting> pareto_settings(bool quick) {
    std::vector<ParetoSetting> settings;
    for (const double voxel_mm : {0.4, 0.2, 0.1, 0.05}) {
        const std::string label = millimetres(voxel_mm);
        const MillingSettings binary{.coverage = VoxelCoverage::binary};
        const MillingSettings published{.summation = ForceSummation::bins, .coverage = VoxelCoverage::binary};
        settings.push_back({.family = "crescent of soft voxels",
                            .label = label,
                            .make = voxel_model(),
                            .voxel_mm = voxel_mm,
                            .is_default = voxel_mm == 0.1});
        settings.push_back({.family = "crescent of binary voxels",
                            .label = label,
                            .make = voxel_model(binary),
                            .voxel_mm = voxel_mm});
        settings.push_back({.family = "crescent of partial voxels",
                            .label = label,
                            .make = voxel_model({.coverage = VoxelCoverage::linear}),
                            .voxel_mm = voxel_mm});
        if (quick && voxel_mm < 0.1) continue;
        settings.push_back({.family = "full scan of soft voxels",
                            .label = label,
                            .make = full_scan_model(),
                            .voxel_mm = voxel_mm});
        settings.push_back({.family = "full scan of binary voxels into bins (published)",
                            .label = label,
                            .make = full_scan_model(published),
                            .voxel_mm = voxel_mm});
    }
    for (const ChipBins bins :
         {ChipBins{18, 12}, ChipBins{36, 25}, ChipBins{72, 50}, ChipBins{144, 100}, ChipBins{288, 200}})
        settings.push_back({.family = "crescent into bins psi x z",
                            .label = fmt::format("{} x {}", bins.psi, bins.z),
                            .make = voxel_model({.summation = ForceSummation::bins, .bins = bins})});
    for (const double rate_hz : {1000.0, 10'000.0})
        settings.push_back({.family = "crescent at 1 and 10 kHz",
                            .label = fmt::format("{:.0f} kHz", rate_hz / 1000.0),
                            .make = voxel_model(),
                            .milling_rate_hz = rate_hz});
    for (const int instants : quick ? std::vector{20} : std::vector{5, 20, 60})
        settings.push_back(
            {.family = "crescent at 10 kHz with 5 20 and 60 instants a tooth",
             .label = fmt::format("N = {}", instants),
             .make = voxel_model({.summation = ForceSummation::instants, .instants_per_tooth = instants}),
             .milling_rate_hz = 10'000.0,
             .run_in_s = tooth_periods_to_forget_s});
    settings.push_back(
        {.family = "crescent and engagement map", .label = "0.1 mm", .make = voxel_model_with_engagement()});
    return settings;
}

ParetoPoint measure(const ParetoSetting& setting, const std::vector<StudiedMotion>& motions, bool quick) {
    ParetoPoint point{.setting = setting};
    std::vector<double> step_us;
    const std::size_t shifts = quick ? 1 : lattice_shifts_mm.size();
    for (const StudiedMotion& motion : motions) {
        double error = 0.0;
        for (std::size_t i = 0; i < shifts; ++i) {
            const ForceSeries series = run_motion(motion,
                                                  {.voxel_mm = setting.voxel_mm,
                                                   .milling_rate_hz = setting.milling_rate_hz,
                                                   .lattice_shift_mm = lattice_shifts_mm[i],
                                                   .run_in_s = setting.run_in_s},
                                                  setting.make);
            error += relative_error(mean_force_n(series), motion.reference_n) / static_cast<double>(shifts);
            // A curved path turns the force; that is no ripple.
            if (motion.name != "curved") point.worst_ripple = std::max(point.worst_ripple, ripple(series));
            step_us.insert(step_us.end(), series.step_us.begin(), series.step_us.end());
        }
        point.errors.push_back(error);
    }
    point.mean_error = std::accumulate(point.errors.begin(), point.errors.end(), 0.0) /
                       static_cast<double>(std::max<std::size_t>(1, point.errors.size()));
    point.step_us_mean = std::accumulate(step_us.begin(), step_us.end(), 0.0) /
                         static_cast<double>(std::max<std::size_t>(1, step_us.size()));
    point.step_us_p50 = percentile(step_us, 0.5);
    point.step_us_p99 = percentile(step_us, 0.99);
    return point;
}

std::string csv_of(const std::vector<ParetoPoint>& points, const std::vector<StudiedMotion>& motions) {
    std::string csv =
        "family,label,voxel_mm,milling_rate_hz,step_us_mean,step_us_p50,step_us_p99,core_percent,mean_error_"
        "percent,"
        "worst_ripple_percent,is_default";
    for (const StudiedMotion& motion : motions) csv += fmt::format(",{} error_percent", motion.name);
    csv += '\n';
    for (const ParetoPoint& p : points) {
        csv += fmt::format("{},{},{},{:.0f},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{}", p.setting.family,
                           p.setting.label, p.setting.voxel_mm, p.setting.milling_rate_hz, p.step_us_mean,
                           p.step_us_p50, p.step_us_p99, 1e-4 * p.step_us_mean * p.setting.milling_rate_hz,
                           100.0 * p.mean_error, 100.0 * p.worst_ripple, p.setting.is_default ? 1 : 0);
        for (const double error : p.errors) csv += fmt::format(",{:.4f}", 100.0 * error);
        csv += '\n';
    }
    return csv;
}

}  // namespace osteomill::study
