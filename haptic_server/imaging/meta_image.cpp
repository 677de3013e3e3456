#include "haptic_server/imaging/meta_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/regular_file.h"

namespace osteomill {

namespace {

/// Turns bytes into values as they come; a voxel may lie across two pieces.
template <typename Voxel>
class Converter {
  public:
    Converter(bool big_endian, std::vector<float>& values)
        : swapped_(big_endian != (std::endian::native == std::endian::big)), values_(values) {}

    void take(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) {
            raw_[filled_++] = byte;
            if (filled_ < sizeof(Voxel)) continue;
            filled_ = 0;
            std::array<std::uint8_t, sizeof(Voxel)> ordered = raw_;
            if (swapped_) std::reverse(ordered.begin(), ordered.end());
            Voxel voxel{};
            std::memcpy(&voxel, ordered.data(), sizeof voxel);
            values_.push_back(static_cast<float>(voxel));
        }
    }

  private:
    bool swapped_;
    std::vector<float>& values_;
    std::array<std::uint8_t, sizeof(Voxel)> raw_{};
    std::size_t filled_ = 0;
};

template <typename Voxel>
std::vector<float> values_of(const MetaImage& image) {
    std::vector<float> values;
    values.reserve(voxel_count(image.header.image));
    Converter<Voxel> converter(image.header.big_endian, values);
    read_voxel_data(image.data, [&](std::span<const std::uint8_t> bytes) { converter.take(bytes); });
    return values;
}

}  // namespace

MetaImage open_meta_image(const std::filesystem::path& path) {
    MetaImage image{
        .header = parse_meta_image_header(RegularFile(path).first_bytes(most_meta_image_header_bytes), path),
        .data = {}};
    const MetaImageHeader& header = image.header;
    image.data.encoding = header.encoding;
    const std::uint64_t all_bytes = voxel_count(header.image) * element_bytes(header.element);
    const auto add = [&](const std::filesystem::path& file, std::uint64_t begin, std::uint64_t bytes) {
        const std::uint64_t size = RegularFile(file).size();
        const std::uint64_t voxels_begin = header.header_size >= 0
                                               ? begin + static_cast<std::uint64_t>(header.header_size)
                                               : size - std::min(size, bytes);
        image.data.parts.push_back({.file = file, .begin = voxels_begin, .bytes = bytes});
    };
    // In the header's own file the voxels follow it; HeaderSize is of files that know nothing of MetaImage.
    if (header.data_files.empty())
        image.data.parts.push_back({.file = path, .begin = header.bytes, .bytes = all_bytes});
    for (const std::string& name : header.data_files)
        add(data_file_beside(path, name), 0, all_bytes / header.data_files.size());
    if (const std::uint64_t more = require_whole(image.data); more > 0)
        image.header.image.notes.push_back(
            fmt::format("{}: {} bytes follow its voxels; they are not read", path.string(), more));
    return image;
}

std::vector<float> read_meta_image_values(const MetaImage& image) {
    switch (image.header.element) {
        case MetaElement::int8:
            return values_of<std::int8_t>(image);
        case MetaElement::uint8:
            return values_of<std::uint8_t>(image);
        case MetaElement::int16:
            return values_of<std::int16_t>(image);
        case MetaElement::uint16:
            return values_of<std::uint16_t>(image);
        case MetaElement::int32:
            return values_of<std::int32_t>(image);
        case MetaElement::uint32:
            return values_of<std::uint32_t>(image);
        case MetaElement::float32:
            return values_of<float>(image);
        case MetaElement::float64:
            break;
    }
    return values_of<double>(image);
}

}  // namespace osteomill
