#include "haptic_server/imaging/formats/meta_image.h"

#include <fmt/format.h>

#include <algorithm>

#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

MetaImage open_meta_image(const std::filesystem::path& path) {
    MetaImage image{
        .header = parse_meta_image_header(RegularFile(path).first_bytes(most_meta_image_header_bytes), path),
        .data = {}};
    const MetaImageHeader& header = image.header;
    image.data.encoding = header.encoding;
    const std::uint64_t all_bytes = voxel_count(header.image) * bytes_of(header.voxels.type);
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
    if (const std::uint64_t more = require_room(image.data); more > 0)
        image.header.image.notes.push_back(
            fmt::format("{}: {} bytes follow its voxels; they are not read", path.string(), more));
    return image;
}

}  // namespace osteomill
