// Blocks of bone below a plane that may point anywhere, voxelised as a CT would: each voxel holds the part of
// it that lies in bone.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"

namespace osteomill::study {

/// A softer or stiffer layer at the surface.
struct TopLayer {
    double thickness_mm = 0.0;
    double stiffness =
        1.0;  ///< relative, a multiple of 0.02 (the code of a voxel) up to 5; 1 below the layer
};

/// Bone {p . up <= surface_mm} within a box; patient axes, mm.
struct BoneBlock {
    glm::dvec3 low_mm{0.0};
    glm::dvec3 high_mm{0.0};
    glm::dvec3 up{0.0, 0.0, 1.0};  ///< unit
    double surface_mm = 0.0;
    std::optional<TopLayer> layer{};
    /// Whether voxels at the surface hold as much as a burr leaves of them (voxel_coverage.h), in the place
    /// of their exact part: the ramp of that is wider than a cube's.
    bool is_milled = false;
};

/// Voxelises a block. The box grows outward to whole multiples of `spacing_mm`, so that the faces of voxels
/// lie at multiples of it from the patient's origin and a plane through the origin along an axis is met
/// exactly. A voxel that the plane cuts holds the exact part of it; its stiffness is that of its centre.
/// Throws std::invalid_argument for a bad grid.
Bone voxelised(const BoneBlock& block, double spacing_mm);

/// A solid cube whose top face lies at z = 0, its middle below the origin; within a box of `box_voxels` an
/// edge, or its own if that is 0. Edges are multiples of 16 voxels, or std::invalid_argument is thrown.
Bone cube_of_bone(int edge_voxels, double spacing_mm, int box_voxels = 0);

}  // namespace osteomill::study
