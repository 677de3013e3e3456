// Bricks around a ball, looked up once for many samples near it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"

namespace osteomill {

static_assert(std::endian::native == std::endian::little);

namespace detail {

/// Two neighbouring bytes.
inline std::uint64_t pair_at(const std::uint8_t* bytes) {
    std::uint16_t pair;
    std::memcpy(&pair, bytes, sizeof pair);
    return pair;
}
/// A voxel's fraction and its seven neighbours', within a brick.
inline std::uint64_t cube_at(const std::uint8_t* f) {
    return pair_at(f) | pair_at(f + 16) << 16 | pair_at(f + 256) << 32 | pair_at(f + 272) << 48;
}

}  // namespace detail

class BrickNeighbourhood {
  public:
    /// Holds balls of up to `largest_radius_voxels`. Allocates.
    explicit BrickNeighbourhood(double largest_radius_voxels);

    /// Looks up the bricks that hold the voxels within `radius_voxels` (at most the constructor's) of
    /// `centre_voxels`, and one voxel more. False if none of them is stored: then no other function may be
    /// called. `bone` must outlive these calls. Real-time safe.
    bool gather(const Bone& bone, const glm::dvec3& centre_voxels, double radius_voxels) noexcept;

    /// Voxel that positions are counted from: the corner of the first brick, which may lie outside the grid.
    const glm::ivec3& base() const { return base_; }

    /// Slot of the brick that holds a voxel of the ball, or BoneContent::no_slot.
    std::int32_t slot(const glm::ivec3& position) const {
        return slots_[static_cast<std::size_t>((position.x >> 4) +
                                               edge_ * ((position.y >> 4) + edge_ * (position.z >> 4)))];
    }

    /// Fractions of a voxel within the ball and of its seven neighbours beyond it, a byte each: first along
    /// x, then y, then z, the first lowest.
    std::uint64_t corners(const glm::ivec3& first) const;

    /// The corners of the voxel with the index `in_brick` in the brick x + edge() (y + edge() z), bricks
    /// counted from the base's: for a voxel that is not the last of its brick along any axis, and for one
    /// that is.
    std::uint64_t corners_within(std::int32_t brick, std::int32_t in_brick) const {
        const std::uint8_t* const fractions = fractions_[static_cast<std::size_t>(brick)];
        return fractions == nullptr ? 0 : detail::cube_at(fractions + in_brick);
    }
    std::uint64_t corners_across(std::int32_t brick, std::int32_t in_brick) const;
    int edge() const { return edge_; }

    /// Fraction, 0 to 255, trilinear between the centres of voxels, at a position within the ball.
    float fraction(const glm::vec3& position) const;

    /// Relative stiffness of the bone of the voxel nearest to a position within the ball; 0 if no brick is
    /// stored.
    double stiffness(const glm::vec3& position) const;
    /// Label of that voxel's tissue; 0 if no brick is stored.
    std::uint8_t tissue(const glm::vec3& position) const;

  private:
    int edge_;  // of the cube of bricks
    const Bone* bone_ = nullptr;
    glm::ivec3 base_{0};
    std::vector<std::int32_t> slots_;
    std::vector<const std::uint8_t*> fractions_;  // of the bricks, likewise; null where none is stored
};

namespace detail {

/// Between the corners of a cube in the order x, y, z, weighed by the position within it; `Real` is a number
/// or a vector of numbers.
template <typename Real>
[[gnu::always_inline]] inline Real trilinear(const std::array<Real, 8>& c, const Real& wx, const Real& wy,
                                             const Real& wz) {
    const Real y0z0 = c[0] + wx * (c[1] - c[0]);
    const Real y1z0 = c[2] + wx * (c[3] - c[2]);
    const Real y0z1 = c[4] + wx * (c[5] - c[4]);
    const Real y1z1 = c[6] + wx * (c[7] - c[6]);
    const Real z0 = y0z0 + wy * (y1z0 - y0z0);
    const Real z1 = y0z1 + wy * (y1z1 - y0z1);
    return z0 + wz * (z1 - z0);
}

}  // namespace detail

inline std::uint64_t BrickNeighbourhood::corners(const glm::ivec3& first) const {
    const std::int32_t brick = (first.x >> 4) + edge_ * ((first.y >> 4) + edge_ * (first.z >> 4));
    const auto in_brick = static_cast<std::int32_t>(offset_in_brick(first));
    const bool within = (first.x & 15) != 15 && (first.y & 15) != 15 && (first.z & 15) != 15;
    return within ? corners_within(brick, in_brick) : corners_across(brick, in_brick);
}

}  // namespace osteomill
