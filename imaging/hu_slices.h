// CT numbers slice after slice, z ascending, from which a bone is built if the whole would not fit in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "common/bone/grid.h"

namespace osteomill {

struct HuSlices {
    Grid grid;
    bool labelled = false;
    /// Fills `hu` with the next slices, as many as fit (x fastest, then y, then z; never more than are left),
    /// and `tissue`, as long, with their labels if there are labels; else it is empty.
    std::function<void(std::span<std::int16_t> hu, std::span<std::uint8_t> tissue)> read;
    /// The distance of a voxel's centre from the surface, voxels, negative in bone, right within a voxel of
    /// the surface. For a surface that is known better than CT numbers tell it, such as a phantom's; else
    /// empty.
    std::function<double(const glm::ivec3& voxel)> surface_distance_voxels{};
};

}  // namespace osteomill
