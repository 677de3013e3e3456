#include "studies/force/path_run.h"

#include <chrono>

namespace osteomill::study {

ForceSeries run_path(StudiedModel& model, const glm::dvec3& spindle_axis, double step_s,
                     std::span<const glm::dvec3> positions_mm) {
    ForceSeries series{.step_s = step_s};
    if (positions_mm.empty()) return series;
    const auto go = [&](const glm::dvec3& to, bool spindle_on) {
        return model.step(
            {.pose = {to, spindle_axis}, .spindle_on = spindle_on, .burr = 0, .elapsed_s = step_s});
    };
    go(positions_mm.front(), false);
    go(positions_mm.front(), true);
    for (const glm::dvec3& to : positions_mm.subspan(1)) {
        const auto before = std::chrono::steady_clock::now();
        const StepOutcome outcome = go(to, true);
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - before;
        series.step_us.push_back(taken.count());
        series.force_n.push_back(outcome.force_n);
        series.removed_mm3.push_back(outcome.removed_mm3);
    }
    return series;
}

}  // namespace osteomill::study
