#include "studies/polishing/published_figures.h"

#include "studies/polishing/force_measures.h"

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

Table series_of(const ForceRecord& record) {
    Table table({"t_s", "depth_mm", "force_x_n", "force_y_n", "force_z_n"});
    for (std::size_t i = 0; i < record.size(); i += ticks_a_line) {
        const RecordedForce& sample = record[i];
        table.add({sample.time_s - record.front().time_s, sample.depth_mm, sample.force_n.x, sample.force_n.y,
                   sample.force_n.z});
    }
    return table;
}

Table as_meant(const Scene& scene) {
    constexpr double tick_s = 0.001;
    const Trajectory slide = polishing_slide(scene);
    const auto depth_at = [&](double time_s) { return depth_mm(scene, slide.at(time_s).target.position_mm); };
    double contact_s = 0.0;
    while (contact_s < slide.duration_s() && depth_at(contact_s) <= 0.0) contact_s += tick_s;
    Table table({"t_s", "depth_mm"});
    for (double t_s = 0.0; contact_s + t_s <= slide.duration_s(); t_s += ticks_a_line * tick_s)
        table.add({t_s, depth_at(contact_s + t_s)});
    return table;
}

Table table_of(const std::vector<PolishingSetup>& setups, const std::vector<PolishingRun>& runs) {
    Table table({"force_model", "coupling", "milling_rate_hz", "reached_end", "slide_s", "largest_depth_mm",
                 "stray_mm", "mean_force_n", "limit_cycle_n", "onset_depth_mm", "faults"});
    for (std::size_t i = 0; i < setups.size(); ++i) {
        const PolishingSetup& setup = setups[i];
        const PolishingRun& run = runs[i];
        const std::vector<ForceWindow> windows = windows_of(run.record, window_s);
        table.add({setup.force_model, setup.coupling, setup.milling_rate_hz, run.reached_end, run.slide_s,
                   run.depth_mm, run.stray_mm, mean_force_n(run.record), limit_cycle_n(windows),
                   or_empty(onset_of_chatter_mm(windows)), run.faults});
    }
    return table;
}

}  // namespace osteomill::study
