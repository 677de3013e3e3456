#include "studies/polishing/polishing_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "analysis/logs/force_log.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/loop/milling_session.h"

namespace osteomill::study {

namespace {

/// The slide is broken off then: a hand that waits for its tool may wait for minutes.
constexpr double longest_s = 45.0;

/// What the record of a slide tells of it.
PolishingRun run_of(ForceRecord record, const Scene& scene, bool reached_end) {
    // What was logged before the burr met the bone is not part of the slide.
    const auto first = std::find_if(record.begin(), record.end(),
                                    [](const RecordedForce& sample) { return sample.removed_mm3 > 0.0; });
    record.erase(record.begin(), first);
    PolishingRun run{.record = std::move(record), .reached_end = reached_end};
    for (RecordedForce& sample : run.record) {
        sample.depth_mm = depth_mm(scene, sample.burr_mm);
        run.depth_mm = std::max(run.depth_mm, sample.depth_mm);
        run.stray_mm = std::max(run.stray_mm, std::abs(sample.burr_mm.y - scene.trajectory.start_mm.y));
    }
    if (!run.record.empty()) run.slide_s = run.record.back().time_s - run.record.front().time_s;
    return run;
}

}  // namespace

PolishingRun run_by_hand(const Specimen& cube, const PolishingSetup& setup,
                         const std::filesystem::path& log) {
    const Scene scene = polishing_scene(cube.edge_coefficients_n_per_mm);
    SimulatedDevice device(polishing_slide(scene), scene.device, ArmModel{}, hand_model(Grip::firm));
    ForceLog force_log(log);
    MillingSession session(scene, cube.bone, device,
                           {.clock = ClockKind::virtual_time,
                            .milling_rate_hz = setup.milling_rate_hz,
                            .coupling = setup.coupling,
                            .force_model = setup.force_model,
                            .duration_s = longest_s},
                           &force_log);
    std::atomic<bool> is_over{false};
    session.run(is_over, [&](const ToolState&) {
        if (device.is_finished()) is_over.store(true);
    });
    force_log.close();
    if (!force_log.error().empty()) throw std::runtime_error(force_log.error());
    PolishingRun run = run_of(read_force_log(log), scene, device.is_finished());
    const auto faults = session.report().fault_counts;
    run.faults = std::accumulate(faults.begin(), faults.end(), std::uint64_t{0});
    return run;
}

}  // namespace osteomill::study
