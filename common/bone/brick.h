// Bricks: cubes of 16^3 voxels, the unit in which bone is stored, sent and drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "common/bone/grid.h"

namespace osteomill {

inline constexpr int brick_edge_voxels = 16;
inline constexpr std::size_t brick_voxel_count = 4096;
/// Level of the bone's surface: half of a voxel's 255.
inline constexpr float surface_fraction = 127.5f;

/// One byte a voxel; x runs fastest, then y, then z.
using ByteBrick = std::array<std::uint8_t, brick_voxel_count>;

/// View of the fractions left of a brick's voxels, 0 (none) to 255 (all).
using BrickFractions = std::span<const std::uint8_t, brick_voxel_count>;

/// Place of a brick in its grid, counted in bricks: x + nx (y + ny z).
using BrickIndex = std::uint32_t;

/// Bricks that cover the grid along each axis; the last may reach past the grid's edge (its voxels there are
/// empty).
inline glm::ivec3 size_in_bricks(const Grid& grid) {
    return (grid.size_voxels + (brick_edge_voxels - 1)) / brick_edge_voxels;
}

inline BrickIndex brick_index(const glm::ivec3& size_bricks, const glm::ivec3& brick) {
    return static_cast<BrickIndex>(brick.x) +
           static_cast<BrickIndex>(size_bricks.x) *
               (static_cast<BrickIndex>(brick.y) +
                static_cast<BrickIndex>(size_bricks.y) * static_cast<BrickIndex>(brick.z));
}

inline glm::ivec3 brick_position(const glm::ivec3& size_bricks, BrickIndex index) {
    const auto nx = static_cast<BrickIndex>(size_bricks.x);
    const auto ny = static_cast<BrickIndex>(size_bricks.y);
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / nx / ny)};
}

/// Offset of a voxel within its brick; `voxel` is counted within the grid and is not negative.
inline std::size_t offset_in_brick(const glm::ivec3& voxel) {
    return static_cast<std::size_t>((voxel.x & 15) + 16 * ((voxel.y & 15) + 16 * (voxel.z & 15)));
}

/// The reverse: place of a voxel, counted from its brick's first; `offset` is below brick_voxel_count.
inline glm::ivec3 voxel_in_brick(std::size_t offset) {
    return {static_cast<int>(offset & 15U), static_cast<int>(offset >> 4U & 15U),
            static_cast<int>(offset >> 8U)};
}

}  // namespace osteomill
