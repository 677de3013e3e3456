#include "simulation/loop/clearance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/burr_profile.h"

namespace osteomill {

Clearance clearance_of(const MillingResult& latest, const glm::dvec3& position_mm) noexcept {
    if (latest.step == 0) return Clearance::unknown;
    const Engagement& map = latest.engagement;
    const glm::dvec3 moved = position_mm - latest.pose.position_mm;
    // Written so that nothing is known of a position that is not finite.
    if (!(glm::length(moved) <= Engagement::reach_voxels * map.spacing_mm)) return Clearance::unknown;
    if (latest.has_bone_inside) return Clearance::in_bone;
    const double allowed_mm = clearance_voxels * map.spacing_mm;
    const auto* const end = map.patches.begin() + map.count;
    const auto reaches_in = [&](const auto& patch) {
        return patch.gap_mm - glm::dot(patch.normal, moved) < -allowed_mm;
    };
    const auto* const shank_end = map.shank_patches.begin() + map.shank_count;
    const bool is_in_bone = std::any_of(map.patches.begin(), end, reaches_in) ||
                            std::any_of(map.shank_patches.begin(), shank_end, reaches_in);
    return is_in_bone ? Clearance::in_bone : Clearance::clear;
}

namespace {

/// Adds balls around a cone; each holds a slice that is as high as the cone is wide there.
void add_cone(const ShankPoint& low, const ShankPoint& high, std::vector<HullBall>& hull) {
    double height_mm = low.height_mm;
    while (height_mm < high.height_mm) {
        const auto radius_at = [&](double at_mm) {
            const double share = (at_mm - low.height_mm) / (high.height_mm - low.height_mm);
            return low.radius_mm + share * (high.radius_mm - low.radius_mm);
        };
        const double next_mm = std::min(height_mm + radius_at(height_mm), high.height_mm);
        const double half_mm = 0.5 * (next_mm - height_mm);
        const double widest_mm = std::max(radius_at(height_mm), radius_at(next_mm));
        hull.push_back({height_mm + half_mm, std::hypot(widest_mm, half_mm)});
        height_mm = next_mm;
    }
}

}  // namespace

std::vector<HullBall> burr_hull(const Burr& burr) {
    std::vector<HullBall> hull;
    if (burr.is_ball()) {
        hull.push_back({0.0, burr.radius_mm()});
    } else {
        const BurrProfile head(burr.head, burr.diameter_mm);
        add_cone({head.tip_height(), burr.radius_mm()}, {head.top_height(), burr.radius_mm()}, hull);
    }
    for (std::size_t i = 0; i + 1 < burr.shank.size(); ++i) add_cone(burr.shank[i], burr.shank[i + 1], hull);
    return hull;
}

}  // namespace osteomill
