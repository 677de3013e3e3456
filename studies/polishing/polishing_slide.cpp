#include "studies/polishing/polishing_slide.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/logs/csv_log.h"
#include "devices/simulated/simulated_device.h"
#include "imaging/bone_from_hu.h"
#include "imaging/phantoms/phantom.h"
#include "simulation/loop/milling_session.h"

namespace osteomill::study {

namespace {

/// The slide is broken off then: a hand that waits for its tool may wait for minutes.
constexpr double longest_s = 45.0;

Scene polishing_scene(const glm::dvec3& edge_coefficients_n_per_mm, double spindle_rpm, double stroke_mm) {
    Scene scene = phantom_scene("cube");
    Burr& burr = scene.burrs.at(scene.start_burr);
    burr.spindle_rev_per_s = spindle_rpm / 60.0;
    burr.edge_coefficients_n_per_mm = edge_coefficients_n_per_mm;
    scene.trajectory.width_mm = stroke_mm;
    return scene;
}

Bone polished_cube() {
    return bone_from_hu(std::get<HuSlices>(make_phantom("cube")), phantom_threshold_hu,
                        phantom_scene("cube").stiffness);
}

Trajectory down_to_deepest(const Scene& scene) {
    std::vector<Waypoint> way =
        make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr).waypoints();
    const auto deepest = std::min_element(way.begin(), way.end(), [](const Waypoint& a, const Waypoint& b) {
        return a.pose.position_mm.z < b.pose.position_mm.z;
    });
    way.erase(deepest + 1, way.end());
    return Trajectory(std::move(way));
}

}  // namespace

PolishingSlide::PolishingSlide(const glm::dvec3& edge_coefficients_n_per_mm, double spindle_rpm,
                               double stroke_mm)
    : scene_(polishing_scene(edge_coefficients_n_per_mm, spindle_rpm, stroke_mm)),
      cube_(polished_cube()),
      meant_(down_to_deepest(scene_)) {}

SlideEnd PolishingSlide::run(const PolishingSetup& setup, const std::filesystem::path& log) const {
    SimulatedDevice device(meant_, scene_.device, ArmModel{}, hand_model(Grip::firm));
    ForceLog force_log(log);
    MillingSession session(scene_, cube_, device,
                           {.clock = ClockKind::virtual_time,
                            .milling_rate_hz = setup.milling_rate_hz,
                            .coupling = coupling_named(setup.coupling),
                            .force_model = setup.force_model,
                            .duration_s = longest_s},
                           &force_log);
    std::atomic<bool> is_over{false};
    session.run(is_over, [&](const ToolState&) {
        if (device.is_finished()) is_over.store(true);
    });
    force_log.close();
    if (!force_log.error().empty()) throw std::runtime_error(force_log.error());
    const auto faults = session.report().fault_counts;
    return {.reached_end = device.is_finished(),
            .faults = std::accumulate(faults.begin(), faults.end(), std::uint64_t{0})};
}

}  // namespace osteomill::study
