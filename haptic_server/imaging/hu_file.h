// Bones in files: NRRD of 16-bit HU on an isotropic, axis-aligned LPS grid, gzip-compressed, with what later
// readers need as key-value pairs of the header. 3D Slicer opens them in the right place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

using HeaderKeys = std::map<std::string, std::string>;

/// The key under which bone_import notes the HU at and above which the file's voxels are bone.
inline constexpr const char* threshold_key = "osteomill_threshold_hu";

struct HuFile {
    HuVolume volume;
    HeaderKeys keys;  ///< those that begin with "osteomill_"

    /// The threshold that the file states; absent where it states none or not a number.
    std::optional<double> threshold_hu() const;
};

/// Reads a bone that bone_import wrote, or any scalar volume on such a grid. Throws ImagingError naming the
/// file; one that is not isotropic or not axis-aligned is refused with the advice to run bone_import.
HuFile read_hu_file(const std::filesystem::path& path);

/// Writes HU. Throws ImagingError where the file cannot be written (whole).
void write_hu_file(const std::filesystem::path& path, const HuVolume& volume, const HeaderKeys& keys);

/// The same for one byte a voxel (fractions, labels), x fastest.
void write_byte_file(const std::filesystem::path& path, const Grid& grid,
                     std::span<const std::uint8_t> values, const HeaderKeys& keys);
std::vector<std::uint8_t> read_byte_file(const std::filesystem::path& path, const Grid& expected_grid);

}  // namespace osteomill
