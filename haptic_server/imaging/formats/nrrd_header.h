// The header of a NRRD: how the image lies in the patient, and where its values lie. Described at
// http://teem.sourceforge.net/nrrd/format.html.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "haptic_server/imaging/formats/image_file.h"

namespace osteomill {

/// A header must end within so many bytes.
inline constexpr std::size_t most_nrrd_header_bytes = 1u << 20;

/// As it stands in the file.
struct NrrdHeader {
    /// Field name in lower case to its text ("space" to "left-posterior-superior").
    std::map<std::string, std::string> fields;
    std::map<std::string, std::string> key_values;  ///< "key:=value", line breaks and backslashes unescaped
    std::vector<std::string> listed_files;          ///< of "data file: LIST"
    std::size_t bytes = 0;                          ///< up to and with the blank line

    std::optional<std::string> field(const char* name) const {
        const auto found = fields.find(name);
        return found == fields.end() ? std::nullopt : std::optional(found->second);
    }
};

/// What it means.
struct NrrdImage {
    SourceImage image{};
    bool is_placed = false;  ///< it says how it lies in the patient
    int layers = 1;          ///< values of a voxel: the size of a first axis that is none of space
    Encoding encoding = Encoding::raw;
    VoxelLayout voxels{};
    std::uint64_t voxel_bytes = 0;        ///< of all voxels, decoded; of text, the least that they take
    std::int64_t byte_skip = 0;           ///< -1: the voxels are the end of the file
    std::uint64_t line_skip = 0;          ///< lines between the header (or the file's start) and the voxels
    std::vector<std::string> data_files;  ///< empty: the voxels follow the header
};

/// Takes the first bytes of a file apart; pure. `path` is for messages. Throws ImagingError unless they
/// begin with "NRRD", and for a field that stands there twice, a zero byte, or a header without end.
NrrdHeader parse_nrrd_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// Pure. Axes of one voxel that are none of space (a list of one, one time) are left out; lengths in other
/// units become mm. Throws ImagingError for sizes, a type, an encoding, a space, units or data files that
/// cannot be, or that are not read; for other than three axes in space; for a geometry that no scan has.
NrrdImage nrrd_image(const NrrdHeader& header, const std::filesystem::path& path);

/// Reads header and meaning, and finds the voxels. Throws ImagingError, also for files that are missing.
ImageFile open_nrrd(const std::filesystem::path& path);

}  // namespace osteomill
