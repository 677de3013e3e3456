#include "imaging/formats/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "common/files/input_file.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// The offset behind the lines to skip.
std::uint64_t after_lines(const InputFile& file, std::uint64_t begin, std::uint64_t lines) {
    constexpr std::size_t most_bytes_of_lines = 1u << 20;
    if (lines == 0) return begin;
    std::vector<std::uint8_t> bytes(most_bytes_of_lines);
    bytes.resize(file.read_at(begin, std::as_writable_bytes(std::span(bytes))));
    auto at = bytes.begin();
    for (std::uint64_t line = 0; line < lines; ++line) {
        at = std::find(at, bytes.end(), '\n');
        if (at == bytes.end())
            throw ImagingError(file.path(), fmt::format("does not begin with the {} lines that its header "
                                                        "says to skip (line skip)",
                                                        lines));
        ++at;
    }
    return begin + static_cast<std::uint64_t>(at - bytes.begin());
}

VoxelPart part_in(const std::filesystem::path& path, std::uint64_t begin, std::uint64_t bytes,
                  const ImageHeader& header) {
    const InputFile file(path);
    VoxelPart part{.file = path, .begin = after_lines(file, begin, header.line_skip), .bytes = bytes};
    if (header.byte_skip < 0) {
        part.begin = std::max(part.begin, file.size() - std::min(file.size(), bytes));
    } else if (header.encoding == Encoding::gzip) {
        part.skipped_bytes = static_cast<std::uint64_t>(header.byte_skip);
    } else {
        part.begin += static_cast<std::uint64_t>(header.byte_skip);
    }
    return part;
}

}  // namespace

VoxelData find_voxels(const ImageHeader& header, const std::filesystem::path& path) {
    VoxelData data{.encoding = header.encoding, .parts = {}};
    if (header.data_files.empty())
        data.parts.push_back(part_in(path, header.bytes, header.voxel_bytes, header));
    for (const std::string& name : header.data_files)
        data.parts.push_back(
            part_in(data_file_beside(path, name), 0, header.voxel_bytes / header.data_files.size(), header));
    return data;
}

}  // namespace osteomill
