#include "studies/polishing/published_figures.h"

#include <utility>

namespace osteomill::study {

namespace {

/// Of the windows that chatter is looked for in: a few of its cycles, a small part of a stroke.
constexpr double window_s = 0.1;
/// Of the charts' tables: six points in a cycle of 20 Hz.
constexpr std::size_t ticks_a_line = 8;

}  // namespace

std::vector<PolishingSetup> setups_of_figures(bool quick) {
    const auto published = [](const char* force_model, const char* coupling) {
        return PolishingSetup{
            .force_model = force_model, .coupling = coupling, .milling_rate_hz = published_milling_rate_hz};
    };
    std::vector<PolishingSetup> setups;
    for (const char* model : {"milling", "point-spring"}) {
        for (const char* coupling : {"interpolate", "sample-estimate-interpolate", "sample-estimate-hold"})
            setups.push_back(published(model, coupling));
        if (!quick) setups.push_back(published(model, "hold"));
    }
    setups.push_back({});
    return setups;
}

FigureRun judged(PolishingSetup setup, PolishingRun run) {
    FigureRun figure{.setup = std::move(setup), .run = std::move(run)};
    figure.windows = windows_of(figure.run.record, window_s);
    figure.mean_force_n = mean_force_n(figure.run.record);
    figure.limit_cycle_n = limit_cycle_n(figure.windows);
    figure.onset_mm = onset_of_chatter_mm(figure.windows);
    return figure;
}

Table series_of(const ForceRecord& record) {
    Table table({"t_s", "depth_mm", "force_x_n", "force_y_n", "force_z_n"});
    for (std::size_t i = 0; i < record.size(); i += ticks_a_line) {
        const RecordedForce& sample = record[i];
        table.add({sample.time_s - record.front().time_s, sample.depth_mm, sample.force_n.x, sample.force_n.y,
                   sample.force_n.z});
    }
    return table;
}

Table table_of(const std::vector<FigureRun>& figures) {
    Table table({"force_model", "coupling", "milling_rate_hz", "reached_end", "slide_s", "largest_depth_mm",
                 "stray_mm", "mean_force_n", "limit_cycle_n", "onset_depth_mm", "faults"});
    for (const FigureRun& f : figures)
        table.add({f.setup.force_model, f.setup.coupling, f.setup.milling_rate_hz, f.run.reached_end,
                   f.run.slide_s, f.run.depth_mm, f.run.stray_mm, f.mean_force_n, f.limit_cycle_n,
                   or_empty(f.onset_mm), f.run.faults});
    return table;
}

}  // namespace osteomill::study
