#include "studies/force/path_run.h"

#include <chrono>
#include <utility>

namespace osteomill::study {

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
