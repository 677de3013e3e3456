// Voxels removed by one sweep, in batches for SIMD. Those of a batch that lost nothing are in it, too, so
// that batches are filled eight voxels at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace osteomill {

/// Structure of arrays, scratch of a carve: entries beyond the count are not set, except that pad() fills the
/// last group of `lanes`.
struct RemovedVoxels {
    static constexpr std::size_t capacity = 512;
    static constexpr std::size_t lanes = 8;

    glm::ivec3 base{0};  ///< voxel that x, y, z are counted from
    std::size_t count = 0;
    alignas(64) std::array<float, capacity> x;  ///< whole numbers of 0 to a few hundred
    alignas(64) std::array<float, capacity> y;
    alignas(64) std::array<float, capacity> z;
    alignas(64) std::array<float, capacity> levels;  ///< how many of its 255 levels each voxel lost; 0: none
    alignas(64) std::array<std::int32_t, capacity> slot;    ///< brick that holds the voxel
    alignas(64) std::array<std::int32_t, capacity> offset;  ///< the voxel's offset in its brick

    std::size_t padded_count() const { return (count + lanes - 1) / lanes * lanes; }

    /// Sum of the levels. Whole numbers: exact in any order.
    double lost_levels() const {
        std::array<float, lanes> sum{};
        for (std::size_t first = 0; first < padded_count(); first += lanes)
            for (std::size_t lane = 0; lane < lanes; ++lane) sum[lane] += levels[first + lane];
        double total = 0.0;
        for (const float part : sum) total += static_cast<double>(part);
        return total;
    }

    /// Fills up to padded_count() with voxels at the base that lost nothing.
    void pad() {
        for (std::size_t i = count; i < padded_count(); ++i) x[i] = y[i] = z[i] = levels[i] = 0.0f;
    }
};

/// Receives the voxels that a carve removed. Called in the middle of a step: real-time safe.
class RemovalSink {
  public:
    virtual ~RemovalSink() = default;
    virtual void take(const RemovedVoxels& removed) noexcept = 0;
};

}  // namespace osteomill
