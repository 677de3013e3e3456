// Small DICOM series for tests, written with GDCM, each tag of which a test may spoil.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace osteomill::testing {

struct SyntheticSlice {
    glm::dvec3 position_mm{0.0};
    glm::dvec3 along_row{1.0, 0.0, 0.0};
    glm::dvec3 along_column{0.0, 1.0, 0.0};
    glm::dvec2 pixel_spacing_mm{1.0, 1.0};  ///< rows, columns, as DICOM has it
    std::uint16_t columns = 12;
    std::uint16_t rows = 10;
    double slope = 1.0;
    double intercept = -1024.0;
    std::string series_uid = "1.2.826.0.1.3680043.2.1125.1";
    std::vector<std::int16_t> stored{};  ///< pixels as stored; all 0 if empty
    std::uint16_t samples_per_pixel = 1;
    bool with_pixel_data = true;
    bool with_pixel_spacing = true;
    std::string frames{};  ///< Number of Frames, if not empty
};

void write_slice(const std::filesystem::path& file, const SyntheticSlice& slice);

/// `count` slices 2 mm apart along z, every pixel stored as 1024 + 100 * slice number.
std::vector<SyntheticSlice> synthetic_series(int count);

/// Writes 00.dcm, 01.dcm, ... into the folder, which it makes.
void write_series(const std::filesystem::path& folder, const std::vector<SyntheticSlice>& slices);

/// The same image, its pixels coded in JPEG 2000 without loss.
void compress_as_jpeg2000(const std::filesystem::path& from, const std::filesystem::path& to);
/// Compresses in RLE.
void compress_as_rle(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace osteomill::testing
