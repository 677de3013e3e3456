// Meaning of the bytes of a voxel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace osteomill {

enum class VoxelType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

inline std::uint64_t bytes_of(VoxelType type) {
    constexpr std::array<std::uint64_t, 10> bytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

struct VoxelLayout {
    VoxelType type = VoxelType::int16;
    bool big_endian = false;
    double slope = 1.0;  ///< value = slope * stored + intercept
    double intercept = 0.0;
};

}  // namespace osteomill
