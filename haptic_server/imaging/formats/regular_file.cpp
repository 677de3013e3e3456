#include "haptic_server/imaging/formats/regular_file.h"

#include <algorithm>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

RegularFile::RegularFile(const std::filesystem::path& path) try : file_(path, {.what = "an image"}) {
} catch (const std::runtime_error& error) {
    throw ImagingError(error.what());
}

std::size_t RegularFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const try {
    return file_.read_at(offset, bytes);
} catch (const std::runtime_error& error) {
    throw ImagingError(error.what());
}

std::vector<std::uint8_t> RegularFile::first_bytes(std::uint64_t most) const {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::min(most, size())));
    bytes.resize(read_at(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

}  // namespace osteomill
