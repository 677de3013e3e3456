// Distance of any point from a structure, looked up in a table: in bricks near the structure only.
//
// The structure is the union of its voxels' cubes: zero inside them, and distances are to their faces. At
// every voxel centre within reach the squared distance is exact, by a transform along one axis after the
// other (Felzenszwalb and Huttenlocher 2012, Distance Transforms of Sampled Functions, Theory of Computing
// 8). Between centres it is interpolated (trilinear), with a structure's own voxels half a voxel inside; the
// error is less than half a voxel, except midway between parts of a structure that are two or three voxels
// apart. Points outside the grid have a distance like all others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/bone/brick.h"
#include "common/bone/structure_mask.h"

namespace osteomill {

class DistanceField {
  public:
    /// Longest reach, voxels; a longer one is cut down to it, since squares are kept in 16 bits.
    static constexpr double most_reach_voxels = 125.0;

    /// Most bricks of a table: 1 GiB.
    static constexpr std::size_t most_bricks = std::size_t{1} << 17U;

    /// A field of no structure: everything is further than its reach.
    DistanceField() = default;
    /// Allocates. Throws std::invalid_argument for a reach that is no number above 0, or that spans more
    /// bricks than a 32-bit index can number, and std::length_error for a table of more than most_bricks.
    DistanceField(const StructureMask& structure, double reach_mm);

    /// Edge of a voxel.
    double spacing_mm() const { return grid_.spacing_mm; }
    /// How far the table reaches, mm.
    double reach_mm() const { return reach_mm_; }
    /// From the structure's surface, 0 inside; nothing beyond reach_mm(). Real-time safe, from any number of
    /// threads.
    std::optional<float> distance_mm(const glm::dvec3& position_mm) const noexcept;
    std::size_t memory_bytes() const;

  private:
    /// Squared distance in half voxels, from a voxel's centre to the next face of the structure: 0 in it.
    using SquareBrick = std::array<std::uint16_t, brick_voxel_count>;

    void find_bricks(const StructureMask& structure);
    void transform_along(int axis, std::uint32_t most_square);
    void drop_far_bricks();
    std::uint16_t square_at(const glm::ivec3& voxel) const noexcept;

    Grid grid_{};  // of bricks that may lie outside the bone's; its origin is the first one's
    glm::ivec3 size_bricks_{0};
    double reach_mm_ = 0.0;
    BrickTable slot_of_brick_;
    std::vector<BrickIndex> bricks_;  // ascending
    std::vector<SquareBrick> squares_;
};

}  // namespace osteomill
