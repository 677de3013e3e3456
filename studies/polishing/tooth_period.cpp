#include "studies/polishing/tooth_period.h"

#include <glm/geometric.hpp>

#include "studies/polishing/force_measures.h"
#include "studies/polishing/polishing_run.h"

namespace osteomill::study {

namespace {

constexpr double feed_mm_per_s = 6.0;
/// Slow, so that a tooth period is long beside what resolves it: the model lets steps of a few tenths of a
/// millisecond wait for one another at this feed, and even twelve edges take 2 ms to the next.
constexpr double resolved_rpm = 2'500.0;
/// Of the same, and whole revolutions at the other speeds, too: whole tooth periods for any number of edges.
constexpr double revolution_s = 60.0 / resolved_rpm;

/// Mean over whole revolutions first, length after: equation (2) is the mean of a vector.
double mean_of_averaged_n(const ForceRecord& record, double around_s) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t first = 0; first < record.size();) {
        glm::dvec3 force(0.0);
        std::size_t end = first;
        for (; end < record.size() && record[end].time_s < record[first].time_s + around_s - 1e-9; ++end)
            force += record[end].force_n;
        sum += glm::length(force) / static_cast<double>(end - first);
        ++count;
        first = end;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// A revolution from the record's middle on.
ForceRecord clip_of(const ForceRecord& record) {
    const auto middle = record.begin() + static_cast<std::ptrdiff_t>(record.size() / 2);
    ForceRecord clip;
    for (auto sample = middle; sample != record.end() && sample->time_s <= middle->time_s + revolution_s;
         ++sample)
        clip.push_back(*sample);
    return clip;
}

}  // namespace

ToothPeriodForce measure(const Specimen& cube, const PolishingSetup& setup,
                         const std::filesystem::path& log) {
    const PolishingRun run = run_on_rails(cube, setup, log);
    const double mean_n = mean_of_averaged_n(run.record, revolution_s);
    return {.setup = setup,
            .mean_n = mean_n,
            .one_tooth_n = mean_n / setup.edges,
            .peak_over_mean = peak_over_mean(run.record, revolution_s),
            .clip = clip_of(run.record),
            .chip_um = 1000.0 * feed_mm_per_s / (setup.edges * setup.spindle_rpm / 60.0)};
}

std::vector<PolishingSetup> setups_by_edges(bool quick) {
    std::vector<PolishingSetup> setups;
    for (const int edges : quick ? std::vector{1, 3, 6} : std::vector{1, 2, 3, 4, 6, 8, 12}) {
        setups.push_back({.force_model = "milling-instants",
                          .milling_rate_hz = 10'000.0,
                          .spindle_rpm = resolved_rpm,
                          .edges = edges});
        if (quick) setups.back().longest_s = 2.5;
    }
    return setups;
}

std::vector<PolishingSetup> setups_by_speed(bool quick) {
    std::vector<PolishingSetup> setups;
    for (const double rpm : quick ? std::vector{10'000.0, 40'000.0}
                                  : std::vector{10'000.0, 20'000.0, 40'000.0, 80'000.0})
        setups.push_back({.spindle_rpm = rpm});
    return setups;
}

Table table_of(const std::vector<ToothPeriodForce>& forces) {
    Table table({"rpm", "edges", "milling_rate_hz", "mean_n", "one_tooth_n", "peak_over_mean", "chip_um"});
    for (const ToothPeriodForce& f : forces)
        table.add({f.setup.spindle_rpm, f.setup.edges, f.setup.milling_rate_hz, f.mean_n, f.one_tooth_n,
                   f.peak_over_mean, f.chip_um});
    return table;
}

Table clip_of(const ToothPeriodForce& force) {
    Table table({"t_s", "force_n"});
    for (const RecordedForce& sample : force.clip)
        table.add({sample.time_s - force.clip.front().time_s, glm::length(sample.force_n)});
    return table;
}

}  // namespace osteomill::study
