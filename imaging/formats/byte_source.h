// The bytes of a file from an offset on, decoded, one after the other, for data that do not fit in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/files/input_file.h"

namespace osteomill {

enum class Encoding {
    raw,
    gzip,          ///< one member or several, each with its CRC
    zlib_or_gzip,  ///< whichever begins
    text,          ///< numbers in decimal, blanks between; the bytes are those of the text
};

inline bool is_compressed(Encoding encoding) {
    return encoding == Encoding::gzip || encoding == Encoding::zlib_or_gzip;
}

class ByteSource {
  public:
    /// From `offset` to the end of the file.
    ByteSource(std::shared_ptr<const InputFile> file, std::uint64_t offset, Encoding encoding);
    ~ByteSource();
    ByteSource(ByteSource&&) noexcept;
    ByteSource& operator=(ByteSource&&) = delete;

    /// The next bytes, as many as fit. Throws ImagingError if the file ends before, or the encoded data are
    /// damaged.
    void read(std::span<std::byte> bytes);
    /// The next bytes of a source that may end earlier; returns their number.
    std::size_t read_some(std::span<std::byte> bytes);
    void skip(std::uint64_t count);
    /// To be called after the last read: compressed data must end here, their checksum, which covers all of
    /// them, must fit, and nothing may follow. Throws ImagingError.
    void finish();

  private:
    class Inflater;

    std::shared_ptr<const InputFile> file_;
    std::uint64_t offset_;
    Encoding encoding_;
    std::unique_ptr<Inflater> inflater_;  // for compressed data
    std::uint64_t given_ = 0;             // bytes, decoded
};

/// A file's first bytes, at most so many, inflated if they are gzip's. Damage ends them early; the file's
/// reader finds the damage.
std::vector<std::uint8_t> first_bytes_inflated(const InputFile& file, std::size_t most);

/// Whether a file of `file_bytes` may hold `bytes` in this encoding: deflate packs 1032 into one at most.
bool can_hold(std::uint64_t file_bytes, std::uint64_t bytes, Encoding encoding);

}  // namespace osteomill
