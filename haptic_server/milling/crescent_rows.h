// Which voxels of a row can lie in the crescent that a burr cuts in one short step. A superset, quickly
// found: for a step of length L from a to b about its middle m, what changes lies
//
//     within R + 1/2 + L/2 of m       (beyond, no voxel is covered),
//     not within R - 1/2 - L/2 of m   (there the ball at a has left nothing),
//     ahead of the plane through a across the step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "haptic_server/milling/instruction_set.h"
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
    static constexpr int most_rows = 512;  // a multiple of 8
    static constexpr double largest_radius_voxels = 250.0;

    /// `ball` is counted from the base, and so are the voxels `first` <= v < `end` that there are. With
    /// `crescent_only` false, all of the ball is looked at.
    CrescentRows(const Sweep& ball, bool crescent_only, const glm::ivec3& first,
                 const glm::ivec3& end) noexcept;

    /// What the sweep can reach of the voxels that there are.
    VoxelRange columns() const { return columns_; }
    VoxelRange rows() const { return rows_; }  // of any slice
    VoxelRange slices() const { return slices_; }

    /// Whether no voxel of the cube of `edge` voxels from `first` on can change.
    bool misses_cube(const glm::ivec3& first, int edge) const noexcept;

    /// Prepares the rows of slice z and says which there are. Real-time safe.
    VoxelRange begin_slice(int z, InstructionSet instructions) noexcept;

    /// The voxels of row y in the slice, left of the ball's inside or right of it; either may be empty.
    VoxelRange left(int y) const noexcept { return {left_first_[index(y)], left_end_[index(y)]}; }
    VoxelRange right(int y) const noexcept { return {right_first_[index(y)], right_end_[index(y)]}; }

  private:
    void fill_slice(int z, const VoxelRange& rows) noexcept;
    void fill_slice_avx2(int z, const VoxelRange& rows) noexcept;
    std::size_t index(int y) const { return static_cast<std::size_t>(y - rows_.first); }

    glm::vec3 middle_{0.0f};
    float outer_squared_ = 0.0f;
    float inner_squared_ = 0.0f;
    VoxelRange columns_;
    VoxelRange rows_;
    VoxelRange slices_;
    bool crescent_only_ = false;
    glm::vec3 from_{0.0f};
    glm::vec3 direction_{0.0f};  // unit, or zero for a ball at rest
    // The plane through the step's start cuts the row whose points are `ahead` of it in y and z at x =
    // plane_at + ahead * plane_per_ahead. What lies ahead is right of it, left of it or, where the step is
    // nearly across x, all of the row or nothing; the weights (0 or 1) say which.
    float plane_at_ = 0.0f;
    float plane_per_ahead_ = 0.0f;
    float right_weight_ = 0.0f;
    float left_weight_ = 0.0f;
    float row_weight_ = 0.0f;
    alignas(64) std::array<std::int32_t, most_rows> left_first_;  // of the slice, by row
    std::array<std::int32_t, most_rows> left_end_;
    std::array<std::int32_t, most_rows> right_first_;
    std::array<std::int32_t, most_rows> right_end_;
};

}  // namespace osteomill
