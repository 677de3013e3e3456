#include "simulation/force_models/voxel_tool.h"

#include <glm/geometric.hpp>

#include "simulation/force_models/ball_rows.h"

namespace osteomill {

ContactReaction VoxelTool::react(const BurrContact& contact) noexcept {
    ContactReaction reaction{.erosion_per_s = settings_.erosion_per_s};
    double volume_voxels = 0.0;
    glm::dvec3 sum(0.0);
    const auto add = [&](const glm::dvec3& from_centre, double cover, double fraction, std::size_t,
                         std::int32_t) {
        const double weight = cover * fraction;
        volume_voxels += weight;
        const double distance = glm::length(from_centre);
        if (distance > 0.0) sum -= weight / distance * from_centre;
    };
    visit_immersed(contact.bone, {contact.centre_voxels, contact.radius_voxels}, add);

    const double strength = glm::length(sum);
    if (strength == 0.0) return reaction;
    const double volume_mm3 = volume_voxels * voxel_volume_mm3(contact.bone.grid());
    reaction.force_n = settings_.stiffness_n_per_mm3 * volume_mm3 *
                       trust_in_direction(strength, volume_voxels) / strength * sum;
    return reaction;
}

}  // namespace osteomill
