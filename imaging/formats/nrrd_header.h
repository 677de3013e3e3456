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

#include "imaging/formats/image_file.h"

namespace osteomill {

/// A header must end within so many bytes.
inline constexpr std::size_t most_nrrd_header_bytes = 1u << 20;

/// A header as it stands in the file.
struct NrrdHeader {
    /// Field name in lower case to its text ("space" to "left-posterior-superior").
    std::map<std::string, std::string> fields;
    std::map<std::string, std::string> key_values;  ///< "key:=value", line breaks and backslashes unescaped
    std::vector<std::string> listed_files;          ///< from "data file: LIST"
    std::size_t bytes = 0;                          ///< up to and with the blank line

    std::optional<std::string> field(const char* name) const {
        const auto found = fields.find(name);
        return found == fields.end() ? std::nullopt : std::optional(found->second);
    }
};

/// Takes the first bytes of a file apart; pure. `path` is for messages. Throws ImagingError unless they
/// begin with "NRRD", and for a field that stands there twice, a zero byte, or a header without end.
NrrdHeader parse_nrrd_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// Pure. Axes of one voxel that are none of space (a list of one, one time) are left out; lengths in other
/// units become mm. Throws ImagingError for sizes, a type, an encoding, a space, units or data files that
/// cannot be, or that are not read; for other than three axes in space; for a geometry that no scan has.
ImageHeader nrrd_image(const NrrdHeader& header, const std::filesystem::path& path);

/// Reads and interprets the header. Throws ImagingError.
ImageHeader open_nrrd(const std::filesystem::path& path);

}  // namespace osteomill
