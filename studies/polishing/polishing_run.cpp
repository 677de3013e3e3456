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
#include "studies/polishing/guided_device.h"

namespace osteomill::study {

namespace {

template <typename Log>
void close(Log& log) {
    log.close();
    if (!log.error().empty()) throw std::runtime_error(log.error());
}

/// Runs `session` until `device` is at the end of its trajectory.
template <typename Device>
void run_to_the_end(MillingSession& session, const Device& device) {
    std::atomic<bool> is_over{false};
    session.run(is_over, [&](const ToolState&) {
        if (device.is_finished()) is_over.store(true);
    });
}

MillingSessionOptions session_options(const PolishingSetup& setup) {
    return {.clock = ClockKind::virtual_time,
            .milling_rate_hz = setup.milling_rate_hz,
            .coupling = setup.coupling,
            .force_model = setup.force_model,
            .duration_s = setup.longest_s};
}

/// What the record of a slide tells of it.
PolishingRun run_of(ForceRecord record, const Scene& scene, bool reached_end) {
    // What was logged before the burr met the bone is not part of the slide.
    const auto first = std::find_if(record.begin(), record.end(),
                                    [](const RecordedForce& sample) { return sample.removed_mm3 > 0.0; });
    record.erase(record.begin(), first);
    PolishingRun run{.record = std::move(record), .reached_end = reached_end};
    const double radius_mm = scene.burrs.at(scene.start_burr).radius_mm();
    const glm::dvec3 surface_mm = scene.trajectory.start_mm;
    for (RecordedForce& sample : run.record) {
        sample.depth_mm = surface_mm.z + radius_mm - sample.burr_mm.z;
        run.depth_mm = std::max(run.depth_mm, sample.depth_mm);
        run.stray_mm = std::max(run.stray_mm, std::abs(sample.burr_mm.y - surface_mm.y));
    }
    if (!run.record.empty()) run.slide_s = run.record.back().time_s - run.record.front().time_s;
    return run;
}

}  // namespace

PolishingRun run_by_hand(const Specimen& cube, const PolishingSetup& setup,
                         const std::filesystem::path& log) {
    const Scene scene = polishing_scene(setup, cube.edge_coefficients_n_per_mm);
    SimulatedDevice device(polishing_slide(scene), scene.device, setup.arm, setup.hand);
    ForceLog force_log(log);
    MillingSession session(scene, cube.bone, device, session_options(setup), &force_log);
    run_to_the_end(session, device);
    close(force_log);
    PolishingRun run = run_of(read_force_log(log), scene, device.is_finished());
    const auto faults = session.report().fault_counts;
    run.faults = std::accumulate(faults.begin(), faults.end(), std::uint64_t{0});
    return run;
}

PolishingRun run_on_rails(const Specimen& cube, const PolishingSetup& setup,
                          const std::filesystem::path& log) {
    const Scene scene = polishing_scene(setup, cube.edge_coefficients_n_per_mm);
    GuidedDevice device(polishing_slide(scene));
    MillingLog milling_log(log);
    MillingSessionOptions options = session_options(setup);
    options.coupling = "interpolate";  // the burr is where the device is
    MillingSession session(scene, cube.bone, device, options, nullptr, &milling_log);
    run_to_the_end(session, device);
    close(milling_log);
    return run_of(read_milling_log(log), scene, device.is_finished());
}

}  // namespace osteomill::study
