// The bricks around a ball, looked up once so that many samples near it need not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"

namespace osteomill {

class BrickNeighbourhood {
  public:
    /// Room for balls of up to `largest_radius_voxels`. Allocates.
    explicit BrickNeighbourhood(double largest_radius_voxels);

    /// Looks up the bricks that hold the voxels within `radius_voxels` (no larger than there is room for) of
    /// `centre_voxels`, and one voxel more. False where none of them is stored: then nothing else may be
    /// asked. `bone` must outlive the questions. Real-time safe.
    bool gather(const Bone& bone, const glm::dvec3& centre_voxels, double radius_voxels) noexcept;

    /// Voxel that places are counted from: the corner of the first brick, which may lie outside the grid.
    const glm::ivec3& base() const { return base_; }

    /// Slot of the brick that holds a voxel of the ball, or BoneContent::no_slot.
    std::int32_t slot(const glm::ivec3& place) const {
        return slots_[static_cast<std::size_t>((place.x >> 4) +
                                               edge_ * ((place.y >> 4) + edge_ * (place.z >> 4)))];
    }

    /// Fraction, 0 to 255, trilinear between the centres of voxels, at a place within the ball.
    float fraction(const glm::vec3& place) const;

    /// Relative stiffness of the bone of the voxel nearest to a place within the ball; 0 where no brick is
    /// stored.
    double stiffness(const glm::vec3& place) const;

  private:
    float fraction_across_bricks(const glm::ivec3& first, const glm::vec3& w) const;

    int edge_;  // of the cube of bricks
    const Bone* bone_ = nullptr;
    glm::ivec3 base_{0};
    std::vector<std::int32_t> slots_;
};

namespace detail {

/// Corners in the order x, y, z of a cube, weighed by the place within it.
inline float trilinear(float c000, float c100, float c010, float c110, float c001, float c101, float c011,
                       float c111, const glm::vec3& w) {
    const float y0z0 = c000 + w.x * (c100 - c000);
    const float y1z0 = c010 + w.x * (c110 - c010);
    const float y0z1 = c001 + w.x * (c101 - c001);
    const float y1z1 = c011 + w.x * (c111 - c011);
    const float z0 = y0z0 + w.y * (y1z0 - y0z0);
    const float z1 = y0z1 + w.y * (y1z1 - y0z1);
    return z0 + w.z * (z1 - z0);
}

}  // namespace detail

inline float BrickNeighbourhood::fraction(const glm::vec3& place) const {
    const glm::ivec3 first(place);
    const glm::vec3 w = place - glm::vec3(first);
    const bool within_one_brick = (first.x & 15) != 15 && (first.y & 15) != 15 && (first.z & 15) != 15;
    if (!within_one_brick) return fraction_across_bricks(first, w);
    const std::int32_t at = slot(first);
    if (at == BoneContent::no_slot) return 0.0f;
    const std::uint8_t* const f = bone_->fractions(at).data() + offset_in_brick(first);
    return detail::trilinear(f[0], f[1], f[16], f[17], f[256], f[257], f[272], f[273], w);
}

}  // namespace osteomill
