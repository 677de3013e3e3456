// A braincase: a closed shell of homogeneous bone between two ellipsoids, in a grid as large as a head. Made
// brick by brick from its formula: HU on 2048^3 voxels would take 16 GiB, the bone in it takes a fiftieth of
// their number.
#pragma once

#include <glm/vec3.hpp>

#include "common/bone/bone.h"

namespace osteomill {

/// Bone lies outside the ellipsoid of half axes `outer_radii_mm - thickness_mm` and inside that of
/// `outer_radii_mm`, both around the origin of patient space, axes along the grid's.
struct Braincase {
    Grid grid;
    glm::dvec3 outer_radii_mm{0.0};
    double thickness_mm = 0.0;
};

/// The phantom of the scene "head": 2048^3 voxels of 0.1 mm. 148 mm wide, 184 mm long, 152 mm high, as an
/// adult's; 2.2 mm thick, as the thinner parts of the vault are, so that 2 % of the grid is bone.
Braincase head_braincase();

/// Relative stiffness 1, no labels. A voxel on a surface is filled in part, cover = clamp(1/2 - d / h, 0, 1)
/// with the distance of distance_field::ellipsoid, as burrs carve. Deterministic to the bit; the grid outside
/// the bone costs a test for each brick. Throws std::invalid_argument for a bad grid or a thickness that is
/// not between zero and the least radius.
Bone make_braincase(const Braincase& shape);

}  // namespace osteomill
