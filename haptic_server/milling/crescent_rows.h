// Which voxels of a row can lie in the crescent that a burr cuts in one short step. A superset, quickly
// found: for a step of length L from a to b about its middle m, what changes lies
//
//     within R + 1/2 + L/2 of m       (beyond, no voxel is covered),
//     not within R - 1/2 - L/2 of m   (there the ball at a has left nothing),
//     ahead of the plane through a across the step.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "haptic_server/milling/sweep.h"

namespace osteomill {

/// Voxels first <= x < end.
struct VoxelRange {
    int first = 0;
    int end = 0;

    bool empty() const { return first >= end; }
};

/// Ranges of the rows of one slice of a sweep no longer than `longest_step_voxels`. All places are counted
/// from a base voxel below and left of the sweep, so that they are positive.
class CrescentRows {
  public:
    static constexpr double longest_step_voxels = 2.0;
    /// Rows that a slice may have, and what burr fits into them.
    static constexpr int most_rows = 512;
    static constexpr double largest_radius_voxels = 250.0;

    /// `ball` is counted from the base. With `crescent_only` false, all of the ball is looked at.
    CrescentRows(const Sweep& ball, bool crescent_only) noexcept;

    /// Rows y and slices z that the sweep can reach, before any grid is considered.
    VoxelRange rows() const { return rows_; }
    VoxelRange slices() const { return slices_; }

    /// Whether no voxel of the cube of `edge` voxels from `first` on can change.
    bool misses_cube(const glm::ivec3& first, int edge) const noexcept;

    /// Prepares the rows of slice z. Real-time safe.
    void begin_slice(int z) noexcept;

    /// The voxels of row y in the slice, left and right of the ball's inside; either may be empty.
    std::array<VoxelRange, 2> ranges(int y) const noexcept;

  private:
    glm::vec3 middle_{0.0f};
    float outer_squared_ = 0.0f;
    float inner_squared_ = 0.0f;
    VoxelRange rows_;
    VoxelRange slices_;
    bool crescent_only_ = false;
    glm::vec3 from_{0.0f};
    glm::vec3 direction_{0.0f};  // unit, or zero for a ball at rest
    float per_direction_x_ = 0.0f;
    float ahead_z_ = 0.0f;
    alignas(64) std::array<float, most_rows> outer_;  // half width of the row within the outer ball, or -1
    alignas(64) std::array<float, most_rows> inner_;  // and within the inner one, or -1
};

}  // namespace osteomill
