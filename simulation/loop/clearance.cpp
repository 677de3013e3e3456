#include "simulation/loop/clearance.h"

#include <algorithm>
#include <glm/geometric.hpp>

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

}  // namespace osteomill
