#include "imaging/resampling/scratch_values.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

int unnamed_file(const std::filesystem::path& folder) {
    const int unnamed = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (unnamed >= 0) return unnamed;
    // Not every file system has files without a name.
    std::string name = (folder / ".osteomill_scratch_XXXXXX").string();
    const int named = ::mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

}  // namespace

ScratchValues::ScratchValues(std::uint64_t count, std::uint64_t most_memory_bytes,
                             const std::filesystem::path& folder) {
    if (count * sizeof(float) <= most_memory_bytes) {
        held_.resize(static_cast<std::size_t>(count));
        values_ = held_;
        return;
    }
    mapped_bytes_ = static_cast<std::size_t>(count) * sizeof(float);
    const int file = unnamed_file(folder);
    // Space is reserved at once: a disk that fills up later would end the program silently.
    const int failed = file < 0 ? errno : ::posix_fallocate(file, 0, static_cast<off_t>(mapped_bytes_));
    if (failed == 0) mapped_ = ::mmap(nullptr, mapped_bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0) ::close(file);
    if (failed != 0)
        throw ImagingError(
            folder, fmt::format("has no room for {:.1f} GiB that the scan takes meanwhile: {}",
                                static_cast<double>(mapped_bytes_) / (1u << 30), std::strerror(failed)));
    if (mapped_ == MAP_FAILED) {
        mapped_ = nullptr;
        throw std::bad_alloc();
    }
    values_ = {static_cast<float*>(mapped_), static_cast<std::size_t>(count)};
}

ScratchValues::~ScratchValues() {
    if (mapped_ != nullptr) ::munmap(mapped_, mapped_bytes_);
}

void ScratchValues::let_go() const {
    // A shared mapping loses nothing: the file keeps written data.
    if (mapped_ != nullptr) ::madvise(mapped_, mapped_bytes_, MADV_DONTNEED);
}

}  // namespace osteomill
