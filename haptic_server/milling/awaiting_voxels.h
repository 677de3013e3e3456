// Voxels that the burr has not met yet: it is near, but what an earlier pass or the bone's surface has left
// of them is less than the ramp of cover.h would. A carve hands them on beside what it removed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace osteomill {

/// Structure of arrays, scratch of a carve: entries beyond the count are not set, except that pad() fills the
/// last group of `lanes`.
struct AwaitingVoxels {
    static constexpr std::size_t capacity = 512;
    static constexpr std::size_t lanes = 8;

    glm::ivec3 base{0};     ///< voxel that places are counted from
    glm::dvec3 from{0.0};   ///< where the burr's centre comes from, voxels
    glm::dvec3 along{0.0};  ///< how far it has come; zero for a ball at rest
    std::size_t count = 0;
    alignas(64) std::array<float, capacity> x;  ///< whole numbers of 0 to a few hundred
    alignas(64) std::array<float, capacity> y;
    alignas(64) std::array<float, capacity> z;
    alignas(64) std::array<float, capacity> left;           ///< of the voxel, in 255 steps: 1 to 254
    alignas(64) std::array<std::int32_t, capacity> slot;    ///< brick that holds the voxel
    alignas(64) std::array<std::int32_t, capacity> offset;  ///< of the voxel in its brick

    std::size_t padded_count() const { return (count + lanes - 1) / lanes * lanes; }

    /// Fills up to padded_count() with voxels at the base of which nothing is left.
    void pad() {
        for (std::size_t i = count; i < padded_count(); ++i) {
            x[i] = y[i] = z[i] = left[i] = 0.0f;
            slot[i] = slot[0];
            offset[i] = offset[0];
        }
    }
};

}  // namespace osteomill
