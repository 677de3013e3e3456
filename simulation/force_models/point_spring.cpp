#include "simulation/force_models/point_spring.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "simulation/force_models/ball_rows.h"
#include "simulation/force_models/bone_surface.h"

namespace osteomill {

namespace {

/// From the burr's centre to the nearest voxel that is at least half there, voxels.
struct NearestVoxel {
    double distance_squared = std::numeric_limits<double>::infinity();
    glm::dvec3 from_centre{0.0};

    bool is_found() const { return distance_squared < std::numeric_limits<double>::infinity(); }
};

NearestVoxel nearest_voxel(const Bone& bone, const Ball& ball) noexcept {
    NearestVoxel nearest;
    visit_rows(bone, ball, [&](const BallRow& row) {
        const auto fractions = bone.fractions(row.slot).subspan(row.row_offset, brick_edge_voxels);
        glm::dvec3 from_centre = glm::dvec3(row.first) - ball.centre;
        const double across_squared = from_centre.y * from_centre.y + from_centre.z * from_centre.z;
        if (across_squared >= nearest.distance_squared) return;
        for (int i = 0; i < row.count; ++i, from_centre.x += 1.0) {
            if (fractions[static_cast<std::size_t>((row.first.x & 15) + i)] < surface_fraction) continue;
            const double distance_squared = from_centre.x * from_centre.x + across_squared;
            if (distance_squared < nearest.distance_squared) nearest = {distance_squared, from_centre};
        }
    });
    return nearest;
}

}  // namespace

ContactReaction PointSpring::react(const BurrContact& contact) noexcept {
    ContactReaction reaction{.erosion_per_s = settings_.erosion_per_s};
    // A surface within the burr may belong to a voxel whose centre lies beyond it.
    const Ball ball{contact.centre_voxels, contact.radius_voxels + 1.0};
    const NearestVoxel nearest = nearest_voxel(contact.bone, ball);
    if (!nearest.is_found()) return reaction;

    const double distance = std::sqrt(nearest.distance_squared);
    const glm::dvec3 to_centre = distance > 0.0 ? -nearest.from_centre / distance : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 voxel = contact.centre_voxels + nearest.from_centre;
    const double within = static_cast<double>(length_in_bone(
        contact.bricks, contact.in_bricks(voxel), glm::vec3(to_centre), static_cast<float>(distance)));
    const glm::dvec3 surface = voxel + within * to_centre;
    const glm::dvec3 normal = outward_normal(contact.bricks, contact.in_bricks(surface));
    const double depth_voxels = contact.radius_voxels - glm::dot(contact.centre_voxels - surface, normal);
    if (depth_voxels > 0.0)
        reaction.force_n = settings_.stiffness_n_per_mm * depth_voxels * contact.spacing_mm() * normal;
    return reaction;
}

}  // namespace osteomill
