// A digest of bytes: 128 bits of XXH3, which tells a damaged channel from the one that was saved. It guards
// against accidents, not against forgers.
#pragma once

#include <xxhash.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace osteomill {

class Digest {
  public:
    static constexpr std::size_t text_length = 32;

    Digest();
    void add(std::span<const std::byte> bytes);
    /// The digest of all bytes so far: 32 hexadecimal digits.
    std::string text() const;

  private:
    struct Free {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, Free> state_;
};

// The digest of a whole NRRD file stands in its own header: it covers every byte of header and data but the
// digest itself. So a flipped bit is found wherever it is, even after another program rewrote the header.

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
