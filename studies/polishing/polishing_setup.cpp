#include "studies/polishing/polishing_setup.h"

#include <algorithm>

#include "imaging/phantoms/phantom.h"

namespace osteomill::study {

namespace {

constexpr double spindle_rpm = 80'000.0;
constexpr double stroke_mm = 8.0;

}  // namespace

Scene polishing_scene(const glm::dvec3& edge_coefficients_n_per_mm) {
    Scene scene = phantom_scene("cube");
    Burr& burr = scene.burrs.at(scene.start_burr);
    burr.spindle_rev_per_s = spindle_rpm / 60.0;
    burr.edge_coefficients_n_per_mm = edge_coefficients_n_per_mm;
    scene.trajectory.width_mm = stroke_mm;
    return scene;
}

Trajectory polishing_slide(const Scene& scene) {
    std::vector<Waypoint> way =
        make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr).waypoints();
    const auto deepest = std::min_element(way.begin(), way.end(), [](const Waypoint& a, const Waypoint& b) {
        return a.pose.position_mm.z < b.pose.position_mm.z;
    });
    way.erase(deepest + 1, way.end());
    return Trajectory(std::move(way));
}

double depth_mm(const Scene& scene, const glm::dvec3& burr_mm) {
    return scene.trajectory.start_mm.z + scene.burrs.at(scene.start_burr).radius_mm() - burr_mm.z;
}

}  // namespace osteomill::study
