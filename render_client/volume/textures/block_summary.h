// Summary of a brick as 4^3 blocks of 4^3 voxels: the sides of a block that bone reaches, and its mean
// fraction. The maps of empty space are made of these, brick by brick.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "common/bone/brick.h"

namespace osteomill {

inline constexpr int block_edge_voxels = 4;
inline constexpr std::size_t blocks_per_brick = 64;

/// Parts of a block that hold a voxel that is at least half full. Bit (dx + 1) + 3 (dy + 1) + 9 (dz + 1),
/// each of d from -1 to 1: the voxels that touch the neighbour in that direction, i.e. the whole block (0, 0,
/// 0), a face, an edge or a corner. Trilinear interpolation within that neighbour reads just those voxels.
using BlockReach = std::uint32_t;

/// By block of the brick, x fastest.
struct BrickSummary {
    std::array<BlockReach, blocks_per_brick> reach{};
    std::array<std::uint8_t, blocks_per_brick> mean_fraction{};  ///< rounded down
};

BrickSummary summary_of_brick(BrickFractions fractions);

/// Offset of the neighbour that a bit of BlockReach (0 to 26) stands for.
constexpr glm::ivec3 neighbour_of_bit(int bit) {
    return {bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
}

}  // namespace osteomill
