// An image's file (input_file.h), whose failures are ImagingErrors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/files/input_file.h"

namespace osteomill {

class RegularFile {
  public:
    /// Follows links. Throws ImagingError for a file that is not there or cannot be opened, and for whatever
    /// is no regular file.
    explicit RegularFile(const std::filesystem::path& path);

    /// Bytes, when it was opened.
    std::uint64_t size() const { return file_.size(); }
    const std::filesystem::path& path() const { return file_.path(); }

    /// Reads into `bytes` from an offset; how many there were, fewer only at the file's end. Throws
    /// ImagingError where the disk fails.
    std::size_t read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

    /// The file's first bytes, at most so many.
    std::vector<std::uint8_t> first_bytes(std::uint64_t most) const;

  private:
    InputFile file_;
};

}  // namespace osteomill
