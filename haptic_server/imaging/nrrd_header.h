// The fields of a NRRD header as they stand in the file. ITK's reader takes a missing orientation, or a
// spacing that is not a number, for a default without a word; here they can be told apart.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace osteomill {

/// Field name in lower case to its text ("space" to "left-posterior-superior"); comments and key-values left
/// out. Throws ImagingError unless the file can be opened and begins with "NRRD".
std::map<std::string, std::string> read_nrrd_header(const std::filesystem::path& path);

/// Throws ImagingError where `spacings` or `space directions` hold a zero or something that is not a number.
void require_spacing(const std::filesystem::path& path, const std::map<std::string, std::string>& header);

}  // namespace osteomill
