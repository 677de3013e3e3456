#include "haptic_server/imaging/formats/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {
ImagingError cannot(const std::filesystem::path& path, const char* what) {
    return ImagingError(path,
                        std::string("cannot be ") + what + ": " + std::generic_category().message(errno));
}
}  // namespace

RegularFile::RegularFile(const std::filesystem::path& path) : path_(path) {
    struct stat facts {};
    // First by name: to open a device may already do something.
    if (::stat(path.c_str(), &facts) != 0) throw cannot(path, "opened");
    const auto refuse = [&] {
        return ImagingError(path, "is not a file (a folder, a pipe or a device?); give the image itself");
    };
    if (!S_ISREG(facts.st_mode)) throw refuse();
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) throw cannot(path, "opened");
    if (::fstat(descriptor_, &facts) != 0 || !S_ISREG(facts.st_mode)) {
        ::close(descriptor_);
        throw refuse();
    }
    size_ = static_cast<std::uint64_t>(facts.st_size);
}

RegularFile::~RegularFile() {
    ::close(descriptor_);
}

std::size_t RegularFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw cannot(path_, "read");
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

std::vector<std::uint8_t> RegularFile::first_bytes(std::uint64_t most) const {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::min(most, size_)));
    bytes.resize(read_at(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

}  // namespace osteomill
