#include "simulation/loop/spindle_torque.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/burr.h"

namespace osteomill {

namespace {

/// At the tip the turn has no direction.
constexpr double least_distance_share = 1e-6;

}  // namespace

double spindle_torque_n_mm(const MillingResult& latest, const Burr& burr,
                           const glm::dvec3& feed_mm_per_s) noexcept {
    const Engagement& engagement = latest.engagement;
    const glm::dmat3 frame = burr_frame(latest.pose.spindle_axis);
    double torque_n_mm = 0.0;
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        if (!cuts(patch, feed_mm_per_s, engagement.spacing_mm)) continue;
        const double x = glm::dot(patch.normal, frame[0]);
        const double y = glm::dot(patch.normal, frame[1]);
        const double share = std::hypot(x, y);
        if (share < least_distance_share) continue;
        const glm::dvec3 force_n =
            glm::dot(patch.normal, feed_mm_per_s) * patch.cutting_n_s_per_mm + patch.edge_n;
        const glm::dvec3 along_turn = (x * frame[1] - y * frame[0]) / share;
        torque_n_mm -= burr.sigma() * burr.radius_mm() * share * glm::dot(force_n, along_turn);
    }
    return torque_n_mm;
}

}  // namespace osteomill
