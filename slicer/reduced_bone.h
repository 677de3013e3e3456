// A copy of the bone in 256^3 voxels at most, for programs that upload a whole volume at each change.
//
// A voxel of it is the mean of n^3 voxels of the bone, n the same along each axis and as small as can be;
// with n = 1 it is the bone itself.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"

namespace osteomill {

/// Voxels `first` to `end`, without `end`.
struct ReducedBox {
    glm::ivec3 first{0};
    glm::ivec3 end{0};

    glm::ivec3 size() const { return end - first; }
    bool operator==(const ReducedBox&) const = default;
};

/// The smallest box around both.
ReducedBox around(const ReducedBox& a, const ReducedBox& b);

class ReducedBone {
  public:
    static constexpr int most_voxels = 256;  ///< along an axis

    explicit ReducedBone(const Bone& bone);

    /// Grid of the reduced voxels.
    const Grid& grid() const { return grid_; }
    int voxels_a_voxel() const { return factor_; }
    ReducedBox whole() const { return {glm::ivec3(0), grid_.size_voxels}; }
    /// Fractions left, 0 to 255; x runs fastest, then y, then z.
    std::span<const std::uint8_t> values() const { return values_; }
    /// Those of a box within the grid, in the same order.
    std::vector<std::uint8_t> values(const ReducedBox& box) const;

    /// Takes over changes of the same bone, and returns their box; nothing if `changes` is empty.
    std::optional<ReducedBox> update(const Bone& bone, std::span<const BrickChange> changes);

  private:
    ReducedBox voxels_of(const glm::ivec3& brick) const;
    void fill(const Bone& bone, const ReducedBox& box);

    int factor_;
    Grid grid_;
    std::vector<std::uint8_t> values_;
};

}  // namespace osteomill
