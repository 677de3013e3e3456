#include "analysis/sessions/learning_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "analysis/report/svg_plot.h"
#include "analysis/statistics/cusum.h"

namespace osteomill::study {

namespace {

void add_trend(SvgPlot& plot, const PracticeTrend& trend, double scale, int attempts) {
    constexpr int steps_per_attempt = 8;
    PlotLine line{.name = "trend", .is_bold = true};
    PlotBand band{.colour = "#333"};
    for (int step = 0; step <= steps_per_attempt * (attempts - 1); ++step) {
        const double attempt = 1.0 + static_cast<double>(step) / steps_per_attempt;
        const Interval interval = trend.interval_at(attempt);
        line.x.push_back(attempt);
        line.y.push_back(scale * trend.at(attempt));
        band.x.push_back(attempt);
        band.low.push_back(scale * interval.low);
        band.high.push_back(scale * interval.high);
    }
    plot.lines.push_back(std::move(line));
    plot.bands.push_back(std::move(band));
}

SvgPlot curve_of(const CaseSessions& sessions, const Headline& what,
                 const std::vector<PracticeValue>& values) {
    SvgPlot plot{.title = what.text, .x_text = "attempt", .y_text = what.unit, .x_is_count = true};
    if (what.better != Better::neither) plot.title += fmt::format(" ({})", text_of(what.better));
    plot.y_from_zero = std::ranges::all_of(values, [](const PracticeValue& one) { return one.value >= 0.0; });
    std::map<std::string, PlotLine> lines;
    int attempts = 1;
    for (const PracticeValue& one : values) {
        PlotLine& line = lines[one.trainee];
        line.name = one.trainee;
        line.has_dots = true;
        line.x.push_back(one.attempt);
        line.y.push_back(what.scale * one.value);
        attempts = std::max(attempts, one.attempt);
    }
    for (auto& [trainee, line] : lines) plot.lines.push_back(std::move(line));
    if (const auto band = expert_band(sessions, what))
        plot.bands.push_back({.text = "middle half of experts",
                              .x = {1.0, static_cast<double>(attempts)},
                              .low = {what.scale * band->low, what.scale * band->low},
                              .high = {what.scale * band->high, what.scale * band->high},
                              .colour = "#56b4e9"});
    if (const auto trend = practice_trend(practice_of(learners(sessions), what)))
        add_trend(plot, *trend, what.scale, attempts);
    return plot;
}

}  // namespace

std::vector<LearningCurve> learning_curves(const CaseSessions& sessions) {
    std::vector<LearningCurve> curves;
    for (const Headline& what : headlines)
        if (const auto values = practice_of(sessions, what); !values.empty())
            curves.push_back({what.key, to_svg(curve_of(sessions, what, values))});
    return curves;
}

std::string pass_chart(const CaseSessions& sessions) {
    const auto passes = passes_of(sessions);
    if (passes.empty()) return {};
    const CusumDesign design;
    SvgPlot plot{
        .title = "Passes and failures, cumulative sum (lower is better)",
        .x_text = "attempt",
        .y_text = "failures beyond the rate",
        .levels = {{design.rise(), fmt::format("fails {:.0f} % or more", 100.0 * design.unacceptable_rate)},
                   {-design.fall(), fmt::format("fails {:.0f} % or less", 100.0 * design.acceptable_rate)}},
        .x_is_count = true};
    for (const auto& [trainee, passed] : passes) {
        PlotLine line{.name = trainee, .y = cusum(passed, design), .has_dots = true};
        for (std::size_t i = 0; i < line.y.size(); ++i) line.x.push_back(static_cast<double>(i));
        plot.lines.push_back(std::move(line));
    }
    return to_svg(plot);
}

}  // namespace osteomill::study
