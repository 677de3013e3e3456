// A file opened for reading that is a file: opening never waits, as it would for a pipe, and never asks a
// device for bytes. It stays the one that was opened, although another takes its name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace osteomill {

class RegularFile {
  public:
    /// Follows links. Throws ImagingError for a file that is not there or cannot be opened, and for whatever
    /// is no regular file.
    explicit RegularFile(const std::filesystem::path& path);
    ~RegularFile();
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    /// Bytes, when it was opened.
    std::uint64_t size() const { return size_; }
    const std::filesystem::path& path() const { return path_; }

    /// Reads into `bytes` from an offset; how many there were, fewer only at the file's end. Throws
    /// ImagingError where the disk fails.
    std::size_t read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

    /// The file's first bytes, at most so many.
    std::vector<std::uint8_t> first_bytes(std::uint64_t most) const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace osteomill
