// The header of a NRRD as it stands in the file, held against what it may say before ITK's reader sees it:
// that one takes a missing orientation, or a spacing that is not a number, for a default without a word, and
// hands the names of data files to printf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "haptic_server/imaging/formats/voxel_data.h"
#include "haptic_server/imaging/formats/voxel_layout.h"

namespace osteomill {

/// A header must end within so many bytes.
inline constexpr std::size_t most_nrrd_header_bytes = 1u << 20;

struct NrrdHeader {
    /// Field name in lower case to its text ("space" to "left-posterior-superior").
    std::map<std::string, std::string> fields;
    std::vector<std::string> listed_files;  ///< of "data file: LIST"
    std::size_t bytes = 0;                  ///< up to and with the blank line
};

/// What the header says of the voxels.
struct NrrdLayout {
    Encoding encoding = Encoding::raw;
    VoxelLayout voxels;
    std::uint64_t voxel_bytes = 0;        ///< of all voxels, decoded; of text, the least that they take
    std::int64_t byte_skip = 0;           ///< -1: the voxels are the end of the file
    std::uint64_t line_skip = 0;          ///< lines between the header (or the file's start) and the voxels
    std::vector<std::string> data_files;  ///< empty: the voxels follow the header
};

/// Takes the first bytes of a file apart; pure. `path` is for messages. Throws ImagingError unless they
/// begin with "NRRD", and for a field that stands there twice, a zero byte, or a header without end.
NrrdHeader parse_nrrd_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// Throws ImagingError for sizes, a type, an encoding or data files that cannot be, or that are not read; for
/// a number of `spacings`, `space directions`, `space origin`, `axis mins` or `axis maxs` that no scan has.
NrrdLayout nrrd_layout(const NrrdHeader& header, const std::filesystem::path& path);

/// Where the voxels lie. Throws ImagingError for files that are missing or no files.
VoxelData nrrd_voxel_data(const NrrdHeader& header, const NrrdLayout& layout,
                          const std::filesystem::path& path);

/// The fields alone. Throws as parse_nrrd_header does, and where the file cannot be opened.
std::map<std::string, std::string> read_nrrd_header(const std::filesystem::path& path);

/// Throws ImagingError where `spacings` or `space directions` hold a zero or something that is not a number.
void require_spacing(const std::filesystem::path& path, const std::map<std::string, std::string>& header);

}  // namespace osteomill
