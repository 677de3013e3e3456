// Order of the voxels of an image in memory: x fastest, then y, then z.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace osteomill {

/// Index of a voxel in an image of `size` voxels, which holds it.
inline std::size_t voxel_index(const glm::ivec3& voxel, const glm::ivec3& size) {
    return static_cast<std::size_t>(voxel.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(voxel.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(voxel.z));
}

}  // namespace osteomill
