// Meaning of the bytes of a voxel.
#pragma once

#include <cstdint>

namespace osteomill {

enum class VoxelType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

inline std::uint64_t bytes_of(VoxelType type) {
    switch (type) {
        case VoxelType::int8:
        case VoxelType::uint8:
            return 1;
        case VoxelType::int16:
        case VoxelType::uint16:
            return 2;
        case VoxelType::int32:
        case VoxelType::uint32:
        case VoxelType::float32:
            return 4;
        default:
            return 8;
    }
}

struct VoxelLayout {
    VoxelType type = VoxelType::int16;
    bool big_endian = false;
    double slope = 1.0;  ///< value = slope * stored + intercept
    double intercept = 0.0;
};

}  // namespace osteomill
