#include "studies/force/path_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace osteomill::study {

namespace {

glm::dvec3 mean_of(std::span<const glm::dvec3> values) {
    if (values.empty()) return glm::dvec3(0.0);
    return std::accumulate(values.begin(), values.end(), glm::dvec3(0.0)) /
           static_cast<double>(values.size());
}

}  // namespace

glm::dvec3 mean_force_n(const ForceSeries& series) {
    return mean_of(series.force_n);
}

double removal_mm3_per_s(const ForceSeries& series) {
    if (series.removed_mm3.empty()) return 0.0;
    return std::accumulate(series.removed_mm3.begin(), series.removed_mm3.end(), 0.0) /
           (series.step_s * static_cast<double>(series.removed_mm3.size()));
}

double relative_error(const glm::dvec3& value, const glm::dvec3& reference) {
    const double difference = glm::length(value - reference);
    const double norm = glm::length(reference);
    if (norm > 0.0) return difference / norm;
    return difference > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

std::vector<double> deviations(const ForceSeries& series, double window_s) {
    const auto window = static_cast<std::size_t>(std::max(1.0, std::round(window_s / series.step_s)));
    const glm::dvec3 mean = mean_force_n(series);
    std::vector<double> shares;
    if (mean == glm::dvec3(0.0)) return shares;
    for (std::size_t first = 0; first + window <= series.force_n.size(); first += window)
        shares.push_back(glm::distance(mean_of(std::span(series.force_n).subspan(first, window)), mean) /
                         glm::length(mean));
    return shares;
}

double ripple(const ForceSeries& series, double window_s) {
    const std::vector<double> shares = deviations(series, window_s);
    if (shares.empty()) return 0.0;
    return std::sqrt(std::inner_product(shares.begin(), shares.end(), shares.begin(), 0.0) /
                     static_cast<double>(shares.size()));
}

double largest_step(const ForceSeries& series) {
    const double mean_n = glm::length(mean_force_n(series));
    double largest_n = 0.0;
    for (const glm::dvec3& force_n : series.force_n) largest_n = std::max(largest_n, glm::length(force_n));
    return mean_n > 0.0 ? largest_n / mean_n : 0.0;
}

namespace {

class Run {
  public:
    Run(StudiedModel& model, const glm::dvec3& spindle_axis, double step_s)
        : model_(model), spindle_axis_(spindle_axis), series_{.step_s = step_s} {}

    void start_at(const glm::dvec3& position_mm) {
        go(position_mm, false);
        go(position_mm, true);
    }
    void step(const glm::dvec3& to_mm) {
        const auto before = std::chrono::steady_clock::now();
        const StepOutcome outcome = go(to_mm, true);
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - before;
        series_.step_us.push_back(taken.count());
        series_.force_n.push_back(outcome.force_n);
        series_.removed_mm3.push_back(outcome.removed_mm3);
    }
    ForceSeries series() && { return std::move(series_); }

  private:
    StepOutcome go(const glm::dvec3& to_mm, bool spindle_on) {
        return model_.step({.pose = {to_mm, spindle_axis_},
                            .spindle_on = spindle_on,
                            .burr = 0,
                            .elapsed_s = series_.step_s});
    }

    StudiedModel& model_;
    glm::dvec3 spindle_axis_;
    ForceSeries series_;
};

}  // namespace

ForceSeries run_path(StudiedModel& model, const glm::dvec3& spindle_axis, double step_s,
                     std::span<const glm::dvec3> positions_mm) {
    Run run(model, spindle_axis, step_s);
    if (!positions_mm.empty()) {
        run.start_at(positions_mm.front());
        for (const glm::dvec3& to : positions_mm.subspan(1)) run.step(to);
    }
    return std::move(run).series();
}

std::vector<ForceSeries> run_in_turns(std::span<const std::unique_ptr<StudiedModel>> models,
                                      const glm::dvec3& spindle_axis, double step_s,
                                      std::span<const glm::dvec3> positions_mm) {
    std::vector<Run> runs;
    for (const auto& model : models) runs.emplace_back(*model, spindle_axis, step_s);
    if (!positions_mm.empty()) {
        for (Run& run : runs) run.start_at(positions_mm.front());
        for (const glm::dvec3& to : positions_mm.subspan(1))
            for (Run& run : runs) run.step(to);
    }
    std::vector<ForceSeries> series;
    for (Run& run : runs) series.push_back(std::move(run).series());
    return series;
}

}  // namespace osteomill::study
