// The bytes behind a header, plain or compressed, one after the other: what does not fit in memory can be
// read so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace osteomill {

/// A file that stays open: the one that was opened, although another takes its name.
class OpenFile {
  public:
    /// Throws ImagingError unless it is a regular file that can be read.
    explicit OpenFile(const std::filesystem::path& path);
    ~OpenFile();
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    /// Reads at an offset; fewer bytes than asked for only at the end. Throws ImagingError.
    std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

enum class Encoding { raw, gzip };  ///< gzip: or a zlib stream, which begins otherwise

class ByteSource {
  public:
    /// From `offset` to the end of the file.
    ByteSource(std::shared_ptr<const OpenFile> file, std::uint64_t offset, Encoding encoding);
    ~ByteSource();
    ByteSource(ByteSource&&) noexcept;
    ByteSource& operator=(ByteSource&&) = delete;

    /// The next bytes, as many as there is room for. Throws ImagingError where the file ends before, or what
    /// was compressed is damaged.
    void read(std::span<std::byte> bytes);
    void skip(std::uint64_t count);
    /// To be called after the last read: compressed data must end here, and their CRC, which covers all of
    /// them, must fit. Bytes behind that belong to nobody. Throws ImagingError.
    void finish();

  private:
    struct Inflater;
    std::shared_ptr<const OpenFile> file_;
    std::uint64_t offset_;
    std::unique_ptr<Inflater> inflater_;  // null: raw
};

/// Whether a file of `file_bytes` may hold `bytes` in this encoding: deflate packs 1032 into one at most.
bool can_hold(std::uint64_t file_bytes, std::uint64_t bytes, Encoding encoding);

}  // namespace osteomill
