// Share of a set of voxels at a point between the centres of eight voxels: trilinear, so that a border
// between voxels is drawn as a surface and not as a staircase.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// Calls `take(voxel, weight)` for each of the eight; the weights add up to one. `place` in voxel
/// coordinates.
template <typename Take>
void for_voxels_about(const glm::dvec3& place, Take&& take) {
    const glm::dvec3 low = glm::floor(place);
    const glm::dvec3 part = place - low;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 weights = glm::mix(1.0 - part, part, glm::dvec3(side));
        take(glm::ivec3(low) + side, weights.x * weights.y * weights.z);
    }
}

/// Whether at least half of the weight at a place is of voxels that `is_in(voxel)`.
template <typename IsIn>
bool is_mostly(const glm::dvec3& place, IsIn&& is_in) {
    double share = 0.0;
    for_voxels_about(place,
                     [&](const glm::ivec3& voxel, double weight) { share += is_in(voxel) ? weight : 0.0; });
    return share >= 0.5;
}

}  // namespace osteomill
