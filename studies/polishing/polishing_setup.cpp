#include "studies/polishing/polishing_setup.h"

#include <algorithm>

#include "imaging/phantoms/phantom.h"

namespace osteomill::study {

Scene polishing_scene(const PolishingSetup& setup, const glm::dvec3& edge_coefficients_n_per_mm) {
    Scene scene = phantom_scene("cube");
    Burr& burr = scene.burrs.at(scene.start_burr);
    burr.spindle_rev_per_s = setup.spindle_rpm / 60.0;
    burr.edges = setup.edges;
    burr.edge_coefficients_n_per_mm = edge_coefficients_n_per_mm;
    scene.trajectory.width_mm = setup.stroke_mm;
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

}  // namespace osteomill::study
