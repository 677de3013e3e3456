// Rows of voxels that can lie in the crescent that a burr cuts in one short step. A superset, quickly found:
// for a step of length L from a to b, the changed voxels lie
//
//     ahead of the plane through a across the step   (behind it, the nearest point of the step is a),
//     within sqrt((R + rim)^2 + L^2) of b            (beyond, no voxel ahead of the plane is covered),
//     not within R - rim of a                        (there the ball at a has left nothing)
//
// with rim_voxels() of voxel_coverage.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/bone/bone.h"
#include "simulation/carving/sweep.h"

namespace osteomill {

/// Voxels first <= x < end.
struct VoxelRange {
    int first = 0;
    int end = 0;

    bool empty() const { return first >= end; }
};

/// Ranges of the rows of a sweep no longer than `longest_step_voxels`. All positions are counted
/// from a base voxel below and left of the sweep, so that they are positive.
class CrescentRows {
  public:
    static constexpr double longest_step_voxels = 2.0;
    /// The burr that fits, and the rows that it may have in a slice, with a margin for a base that is up to
    /// 15 voxels farther away than it need be. A multiple of 16.
    static constexpr double largest_radius_voxels = 250.0;
    static constexpr int most_rows = 528;

    /// `ball` and `rim` in voxels; the ball is counted from the base, and so are the voxels `first` <= v <
    /// `end` that there are. A ball at rest has carved nothing yet: all of it is visited.
    CrescentRows(const Sweep& ball, double rim, const glm::ivec3& first, const glm::ivec3& end) noexcept;

    /// The existing voxels that the sweep can reach.
    VoxelRange columns() const { return columns_; }
    VoxelRange rows() const { return rows_; }
    VoxelRange slices() const { return slices_; }

    /// Whether no voxel of the cube of `edge` voxels from `first` on can change.
    bool misses_cube(const glm::ivec3& first, int edge) const noexcept;

    /// The values that eight_rows() (carve_simd.h) needs, in single precision.
    struct Shape {
        glm::vec3 from{0.0f};
        glm::vec3 to{0.0f};
        float outer_squared = 0.0f;  // about `to`
        float inner_squared = 0.0f;  // about `from`; negative where there is no inner ball
        glm::vec3 direction{0.0f};   // unit, or zero for a ball at rest
        // The plane through the step's start cuts the row whose points are `ahead` of it in y and z at x =
        // plane_at + ahead * plane_per_ahead. The part ahead is right of it, left of it or, if the step is
        // nearly across x, all of the row or nothing; the weights (0 or 1) say which.
        float plane_at = 0.0f;
        float plane_per_ahead = 0.0f;
        float right_weight = 0.0f;
        float left_weight = 0.0f;
        float row_weight = 0.0f;
        // Voxels that there are.
        float first_x = 0.0f;
        float last_x = 0.0f;
        float first_y = 0.0f;
        float last_y = 0.0f;
    };
    const Shape& shape() const { return shape_; }

    /// Slack for single precision, voxels: positions of up to a few hundred, rounded a few times.
    static constexpr double slack_voxels = 1e-3;

  private:
    Shape shape_;
    VoxelRange columns_;
    VoxelRange rows_;
    VoxelRange slices_;
};

// Slots of the bricks that one layer of a short sweep can change, looked up once for all of their rows.

/// Bricks are counted from the one at the sweep's base.
class BrickLayer {
  public:
    /// `base`: the voxel that `rows` counts from, the first of a brick; `z`: any slice of the layer, counted
    /// from it.
    BrickLayer(const Bone& bone, const glm::ivec3& base, const CrescentRows& rows, int z) noexcept
        : first_x_(rows.columns().first / brick_edge_voxels),
          end_x_((rows.columns().end - 1) / brick_edge_voxels + 1),
          first_y_(rows.rows().first / brick_edge_voxels),
          end_y_((rows.rows().end - 1) / brick_edge_voxels + 1) {
        for (int y = first_y_; y < end_y_; ++y) {
            bool any = false;
            for (int x = first_x_; x < end_x_; ++x) {
                const glm::ivec3 brick(x, y, z / brick_edge_voxels);
                std::int32_t slot = bone.slot(base / brick_edge_voxels + brick);
                if (slot != BoneContent::no_slot &&
                    rows.misses_cube(brick * brick_edge_voxels, brick_edge_voxels))
                    slot = BoneContent::no_slot;
                slots_[index_of(x, y)] = slot;
                any |= slot != BoneContent::no_slot;
            }
            holds_bone_[static_cast<std::size_t>(y - first_y_)] = any;
        }
    }

    int first_x() const { return first_x_; }
    int end_x() const { return end_x_; }
    int first_y() const { return first_y_; }
    int end_y() const { return end_y_; }
    /// Whether a brick of the row can change.
    bool row_holds_any(int brick_y) const {
        return holds_bone_[static_cast<std::size_t>(brick_y - first_y_)];
    }
    std::int32_t slot(int brick_x, int brick_y) const { return slots_[index_of(brick_x, brick_y)]; }

  private:
    static constexpr int most = CrescentRows::most_rows / brick_edge_voxels;

    std::size_t index_of(int brick_x, int brick_y) const {
        return static_cast<std::size_t>((brick_y - first_y_) * most + (brick_x - first_x_));
    }

    int first_x_;
    int end_x_;
    int first_y_;
    int end_y_;
    std::array<bool, most> holds_bone_;
    std::array<std::int32_t, std::size_t{most} * most> slots_;
};

}  // namespace osteomill
