// Bones to draw in studies and tests: a shape given as a signed distance, voxels filled as far as the surface
// covers them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "common/bone/bone_builder.h"
#include "common/bone/brick_change.h"

namespace osteomill {

/// mm inside the shape (negative outside) at a patient-space point.
using Depth = std::function<double(const glm::dvec3& position_mm)>;
using Label = std::function<std::uint8_t(const glm::dvec3& position_mm)>;

inline std::uint8_t fraction_of_depth(double depth_mm, double spacing_mm) {
    return static_cast<std::uint8_t>(std::clamp(255.0 * (0.5 + depth_mm / spacing_mm), 0.0, 255.0));
}

/// A bone labelled by `label`, or homogeneous without labels if it is empty.
inline Bone made_bone(const Grid& grid, const Depth& depth, const Label& label = {}) {
    return filled(BoneBuilder::homogeneous(grid, 1.0, static_cast<bool>(label)), grid,
                  [&](const glm::ivec3& voxel) {
                      const glm::dvec3 place = centre_of_voxel_mm(grid, voxel);
                      return VoxelValues{.fraction = fraction_of_depth(depth(place), grid.spacing_mm),
                                         .tissue = label ? label(place) : std::uint8_t{0}};
                  });
}

/// Removes the bone inside a sphere; returns the changes.
inline std::vector<BrickChange> carve_sphere(Bone& bone, const glm::dvec3& centre_mm, double radius_mm) {
    std::vector<BrickChange> changes;
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 brick = brick_position(content.size_bricks, content.brick_of_slot[slot]);
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        BrickChange change{.brick = content.brick_of_slot[slot]};
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::ivec3 voxel = brick * brick_edge_voxels + voxel_in_brick(offset);
            const double outside_mm =
                glm::length(centre_of_voxel_mm(bone.grid(), voxel) - centre_mm) - radius_mm;
            const std::uint8_t most = fraction_of_depth(outside_mm, bone.grid().spacing_mm);
            std::uint8_t& fraction = fractions[offset];
            if (most < fraction) change.voxels.set(offset);
            fraction = std::min(fraction, most);
        }
        if (change.voxels.any()) changes.push_back(change);
    }
    return changes;
}

}  // namespace osteomill
