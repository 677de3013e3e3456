// Surface of the bone, to a fraction of a voxel: where the trilinear fraction is one half. Positions are
// counted from the base of the bricks, as BrickNeighbourhood takes them.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/engagement/brick_neighbourhood.h"

namespace osteomill {

/// Length of a ray from its start in bone (fraction of one half or more) to where it leaves it, voxels; at
/// most `longest`. `direction` is of unit length. It steps by half a voxel, so a narrower gap may be missed.
/// Real-time safe.
float length_in_bone(const BrickNeighbourhood& bricks, const glm::vec3& start, const glm::vec3& direction,
                     float longest) noexcept;

/// Unit vector out of the bone, against the gradient of the fraction over two voxels; zero if there is no
/// gradient, as deep within bone. Real-time safe.
glm::dvec3 outward_normal(const BrickNeighbourhood& bricks, const glm::vec3& position) noexcept;

}  // namespace osteomill
