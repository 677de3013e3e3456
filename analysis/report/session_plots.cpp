#include "analysis/report/session_plots.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <utility>

#include "analysis/report/cutting_metrics.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

/// Events worth a line of their own over every plot, by their number in the list, which has all events.
std::vector<PlotMoment> moments_of(const SessionTrace& trace) {
    std::vector<PlotMoment> moments;
    for (std::size_t i = 0; i < trace.events.size(); ++i)
        if (const ControlEvent& event = trace.events[i];
            !event.is_refused && event.action != SessionAction::finish)
            moments.push_back({event.time_s, std::to_string(i + 1)});
    return moments;
}

std::vector<PlotLine> removed_lines(const SessionTrace& trace) {
    std::map<std::uint8_t, std::int64_t> sums;
    for (const TraceSample& sample : trace.samples)
        for (const TissueLevels& levels : sample.levels) sums[levels.tissue] = 0;
    std::map<std::uint8_t, PlotLine> lines;
    for (const TraceSample& sample : trace.samples) {
        for (const TissueLevels& levels : sample.levels)
            sums[levels.tissue] += levels.milled - levels.restored;
        for (const auto& [label, sum] : sums) {
            PlotLine& line = lines[label];
            line.x.push_back(sample.time_s);
            line.y.push_back(trace.mm3(sum));
        }
    }
    std::vector<PlotLine> all;
    for (auto& [label, line] : lines) {
        line.name = tissue_words(tissue_name(trace.session, label));
        all.push_back(std::move(line));
    }
    return all;
}

/// Distances of the structures that were ever near. While one is further than the watched distance, its line
/// stays there.
std::vector<PlotLine> distance_lines(const SessionTrace& trace) {
    std::vector<PlotLine> lines;
    for (const StructureAccount& account : trace.structures) {
        if (!account.nearest_mm) continue;
        const Tissue& tissue = trace.session.tissues[account.last.tissue];
        PlotLine& line = lines.emplace_back();
        line.name = tissue_words(tissue.name);
        for (const TraceSample& sample : trace.samples) {
            const auto now =
                std::ranges::find(sample.distances, account.last.tissue, &StructureDistance::tissue);
            line.x.push_back(sample.time_s);
            line.y.push_back(now != sample.distances.end() ? now->distance_mm.value_or(watched_mm(tissue))
                                                           : watched_mm(tissue));
        }
    }
    return lines;
}

}  // namespace

std::vector<SvgPlot> session_plots(const SessionTrace& trace) {
    PlotLine force;
    PlotLine depth;
    PlotLine speed;
    const auto& samples = trace.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        force.x.push_back(samples[i].time_s);
        force.y.push_back(samples[i].force_n);
        depth.x.push_back(samples[i].time_s);
        depth.y.push_back(samples[i].depth_mm);
        if (trace.dt_s(i) <= 0.0 || trace.is_discontinuous(i)) continue;
        speed.x.push_back(samples[i].time_s);
        speed.y.push_back(glm::length(samples[i].burr_mm - samples[i - 1].burr_mm) / trace.dt_s(i));
    }
    std::vector<SvgPlot> plots{
        {.title = tr("Force on the hand"), .y_text = "N", .lines = {std::move(force)}},
        {.title = tr("Depth of the burr's tip below first contact"),
         .y_text = "mm",
         .lines = {std::move(depth)}},
        {.title = tr("Removed bone"), .y_text = "mm³", .lines = removed_lines(trace)},
        {.title = tr("Speed of the burr"), .y_text = "mm/s", .lines = {std::move(speed)}}};
    if (std::vector<PlotLine> distances = distance_lines(trace); !distances.empty()) {
        const std::string title = distances.size() == 1 ? trf("Distance to {}", distances[0].name)
                                                        : tr("Distance to protected structures");
        plots.push_back({.title = trf("{} (level at the top: further off)", title),
                         .y_text = "mm",
                         .lines = std::move(distances)});
    }
    for (SvgPlot& plot : plots) {
        plot.x_text = tr("time (s)");
        plot.moments = moments_of(trace);
    }
    return plots;
}

}  // namespace osteomill
