// Place of an image's voxels in its files, as its header says, and whether they are all there. Headers lie,
// so their statements are checked against the files before a reader starts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/formats/byte_source.h"

namespace osteomill {

/// A run of bytes of a file that holds voxels.
struct VoxelPart {
    std::filesystem::path file;
    std::uint64_t begin = 0;
    std::uint64_t bytes = 0;          ///< when decoded; for text, the least that its numbers take
    std::uint64_t skipped_bytes = 0;  ///< decoded bytes before them
};

inline constexpr std::size_t most_data_files = 65535;

struct VoxelData {
    Encoding encoding = Encoding::raw;
    std::vector<VoxelPart> parts;
};

/// "slice%03d.raw" of 7 is "slice007.raw". The pattern is taken apart here and never given to printf: it
/// must hold one % and that must be %d or %0Nd, N at most 99. Throws std::invalid_argument.
std::string numbered_name(std::string_view pattern, std::int64_t number);

/// The words "slice%03d.raw FIRST LAST STEP" as names. Without LAST as many as `wanted`, without STEP one by
/// one. Throws std::invalid_argument if they are not that, name no file or more than 65535.
std::vector<std::string> numbered_names(const std::vector<std::string>& words, std::int64_t wanted = 0);

/// The file of that name beside the header or in a folder below. Throws ImagingError, naming the header, for
/// a name that leads out of the header's folder (an absolute one, "..", a link), for one that no file has
/// (is_there false), and for one that is no regular file.
std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name);

/// Receives the bytes that are read and decoded, piece by piece, in order.
using TakeBytes = std::function<void(std::span<const std::byte>)>;

/// Reads all parts, decoded, and hands them on; for text, all that the files hold, with a blank behind each
/// file. Throws ImagingError, naming the file, if one is missing, cut off or damaged (checksums of gzip
/// and zlib included), or if compressed voxels are followed by more.
void read_voxel_data(const VoxelData& data, const TakeBytes& take);

/// Looks at the files' sizes alone: throws ImagingError if one is missing, too short for its voxels, or
/// too short to be their compressed form. Says by how many bytes the last part's file is longer than it need
/// be (0 if they are encoded). A raw part of several must have its size exactly.
std::uint64_t require_room(const VoxelData& data);

}  // namespace osteomill
