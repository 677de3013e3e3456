// The digest of a whole NRRD file, in its own header: it covers every byte of header and data but the digest
// itself. So a flipped bit is found wherever it is, even after another program rewrote the header.
#pragma once

#include <filesystem>
#include <string>

#include "imaging/bone_file/digest.h"

namespace osteomill {

/// The key's line is "osteomill_digest:=" and Digest::text_length digits, all zero while the digest is taken.
inline constexpr const char* file_digest_key = "osteomill_digest";

/// The placeholder in the header until the digest is known.
inline std::string no_digest_yet() {
    return std::string(Digest::text_length, '0');
}

/// False if a file has none: it is no NRRD, is from elsewhere, or was written anew on purpose. Throws
/// ImagingError if it has another than the file's.
bool has_file_digest(const std::filesystem::path& path);

}  // namespace osteomill
