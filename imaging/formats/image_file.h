// An image file's header, taken apart: how the image lies in the patient, and where its values lie.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "imaging/formats/source_image.h"
#include "imaging/formats/voxel_data.h"

namespace osteomill {

enum class VoxelType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

inline std::uint64_t bytes_of(VoxelType type) {
    constexpr std::array<std::uint64_t, 10> bytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

/// Meaning of the bytes of a voxel.
struct VoxelLayout {
    VoxelType type = VoxelType::int16;
    bool big_endian = false;
    double slope = 1.0;  ///< value = slope * stored + intercept
    double intercept = 0.0;
};

struct ImageHeader {
    SourceImage image{};     ///< its notes list the assumptions
    bool is_placed = false;  ///< whether a NRRD says how it lies in the patient
    int layers = 1;          ///< values of a voxel, side by side
    VoxelLayout voxels{};
    Encoding encoding = Encoding::raw;
    std::uint64_t voxel_bytes = 0;  ///< all voxels, decoded; for text, the least that they take
    std::uint64_t line_skip = 0;    ///< lines between the header (or the file's start) and the voxels
    std::int64_t byte_skip = 0;     ///< then bytes, of gzip's content; -1: the voxels are the end of the file
    std::size_t bytes = 0;          ///< size of the header, if the voxels follow it
    std::vector<std::string> data_files{};            ///< empty: the voxels follow the header
    std::map<std::string, std::string> key_values{};  ///< a NRRD's "key:=value"
};

/// Bytes of so many voxels, decoded. A number in decimal takes a digit, and a blank from the next.
inline std::uint64_t least_bytes(std::uint64_t voxels, VoxelType type, Encoding encoding) {
    return encoding == Encoding::text ? 2 * voxels - 1 : voxels * bytes_of(type);
}

/// Finds the voxels of every file that the header of `path` names, or behind the header. Throws ImagingError
/// if one is missing, or shorter than the part to be skipped.
VoxelData find_voxels(const ImageHeader& header, const std::filesystem::path& path);

}  // namespace osteomill
