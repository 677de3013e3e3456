// Where the voxels of an image lie, as its header says, and whether they are all there. Headers lie; what
// they say is held against the files before a reader is let at them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osteomill {

enum class VoxelEncoding {
    raw,
    gzip,          ///< one member or several, each with its CRC
    zlib_or_gzip,  ///< MetaImage's
    text,          ///< numbers in decimal (or in hexadecimal), which only says how many there are at least
};

/// A run of bytes of a file that holds voxels.
struct VoxelPart {
    std::filesystem::path file;
    std::uint64_t begin = 0;
    std::uint64_t bytes = 0;  ///< when decoded
};

struct VoxelData {
    VoxelEncoding encoding = VoxelEncoding::raw;
    std::vector<VoxelPart> parts;
};

/// "slice%03d.raw" of 7 is "slice007.raw". The pattern is taken apart here and never given to printf: it
/// must hold one % and that must be %d or %0Nd, N at most 99. Throws std::invalid_argument.
std::string numbered_name(std::string_view pattern, std::int64_t number);

/// The file of that name beside the header or in a folder below. Throws ImagingError, naming the header, for
/// a name that leads out of the header's folder (an absolute one, "..", a link), for one that no file has
/// (is_there false), and for what is no regular file.
std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name);

/// What is read and decoded, a piece after the other, in order.
using TakeBytes = std::function<void(std::span<const std::uint8_t>)>;

/// Reads all parts, decoded, and hands them on. Throws ImagingError, naming the file, where one is missing,
/// cut off or damaged (checksums of gzip and zlib included), or where compressed voxels are followed by more.
void read_voxel_data(const VoxelData& data, const TakeBytes& take);

/// As read_voxel_data, for nothing but to see whether it throws; of raw voxels only the sizes are looked at.
/// Says by how many bytes the last part's file is longer than it need be (0 for compressed voxels). A part of
/// several must have its size exactly.
std::uint64_t require_whole(const VoxelData& data);

}  // namespace osteomill
