// Space for a scan's values: in memory, or, if they are more than ought to be held there, in a file without a
// name that is mapped into it and gone with the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace osteomill {

class ScratchValues {
  public:
    /// All zero. A file is made in `folder` if the values take more than `most_memory_bytes`. Throws
    /// ImagingError, naming the folder, if the disk has no space for it; std::bad_alloc.
    ScratchValues(std::uint64_t count, std::uint64_t most_memory_bytes, const std::filesystem::path& folder);
    ~ScratchValues();
    ScratchValues(const ScratchValues&) = delete;
    ScratchValues& operator=(const ScratchValues&) = delete;

    std::span<float> values() const { return values_; }
    /// If the values are in a file, frees this program's memory of them until they are used again; else does
    /// nothing. From any thread, also while others use the values.
    void let_go() const;

  private:
    std::vector<float> held_{};
    void* mapped_ = nullptr;
    std::size_t mapped_bytes_ = 0;
    std::span<float> values_{};
};

}  // namespace osteomill
