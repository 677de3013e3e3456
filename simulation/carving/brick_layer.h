// Slots of the bricks that one layer of a short sweep can change, looked up once for all of their rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/bone/bone.h"
#include "simulation/carving/crescent_rows.h"

namespace osteomill {

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
