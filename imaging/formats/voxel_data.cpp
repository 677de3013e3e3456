#include "imaging/formats/voxel_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "common/files/input_file.h"
#include "common/files/inside_folder.h"
#include "common/text/words.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::size_t piece_bytes = 1u << 18;
/// Deflate shrinks nothing more than 1032 times; a scan, even of labels, is far from that.
constexpr std::uint64_t most_shrunk = 500;
constexpr std::uint64_t suspicious_bytes = std::uint64_t{1} << 30U;

std::uint64_t bytes_there(const InputFile& file, const VoxelPart& part) {
    return file.size() - std::min(file.size(), part.begin);
}

void require_bytes(const InputFile& file, const VoxelPart& part) {
    if (bytes_there(file, part) < part.bytes)
        throw ImagingError(part.file, fmt::format("is cut off: {} of {} bytes of voxels are there",
                                                  bytes_there(file, part), part.bytes));
}

void require_no_bomb(const InputFile& file, const VoxelPart& part) {
    if (part.bytes > suspicious_bytes && part.bytes / most_shrunk > bytes_there(file, part))
        throw ImagingError(part.file, fmt::format("says that {} bytes hold {} bytes of voxels; no scan "
                                                  "compresses so",
                                                  bytes_there(file, part), part.bytes));
}

}  // namespace

std::string numbered_name(std::string_view pattern, std::int64_t number) {
    const auto refuse = [&] {
        return std::invalid_argument(fmt::format(
            "the file pattern '{}': it must hold one number and no other %, such as slice%03d.raw", pattern));
    };
    // Names as long as a path may be would, for as many slices as there may be, fill the memory.
    constexpr std::size_t longest_name = 1024;
    if (pattern.size() > longest_name)
        throw std::invalid_argument(fmt::format("a file pattern of more than {} letters", longest_name));
    const std::size_t percent = pattern.find('%');
    if (percent == std::string_view::npos || pattern.find('%', percent + 1) != std::string_view::npos)
        throw refuse();
    std::string_view rest = pattern.substr(percent + 1);
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    if (digits == rest.size() || rest[digits] != 'd' || digits > 3) throw refuse();
    int width = 0;
    std::from_chars(rest.data(), rest.data() + digits, width);
    // Without the zero printf fills up with blanks, which no file is named with.
    if (width > 99 || (digits > 0 && rest[0] != '0')) throw refuse();
    return std::string(pattern.substr(0, percent)) + fmt::format("{:0{}d}", number, width) +
           std::string(rest.substr(digits + 1));
}

std::vector<std::string> numbered_names(const std::vector<std::string>& words, std::int64_t wanted) {
    constexpr std::int64_t most = 1'000'000'000;
    std::array<std::int64_t, 3> number{1, 0, 1};  // first, last, step
    bool good = words.size() <= 5;                // NRRD may say of how many dimensions each file is
    for (std::size_t i = 0; good && i < std::min(number.size(), words.size() - 1); ++i) {
        number[i] = parse_number<std::int64_t>(words[i + 1]).value_or(most + 1);
        good = std::abs(number[i]) <= most && (i == 2 || number[i] >= 0);
    }
    const auto [first, last, step] = number;
    if (!good || step == 0 || (words.size() < 3 && wanted == 0))
        throw std::invalid_argument("a pattern of data files is 'name%03d.raw FIRST LAST STEP'");
    const bool is_backwards = step > 0 ? last < first : last > first;
    const std::int64_t count = words.size() < 3 ? wanted : is_backwards ? 0 : (last - first) / step + 1;
    if (count < 1) throw std::invalid_argument("a pattern of data files that names none");
    if (count > static_cast<std::int64_t>(most_data_files))
        throw std::invalid_argument(fmt::format("more than {} data files", most_data_files));
    std::vector<std::string> names;
    for (std::int64_t i = 0; i < count; ++i) names.push_back(numbered_name(words[0], first + i * step));
    return names;
}

std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name) {
    const std::filesystem::path given(name);
    const auto refuse = [&](const std::string& reason) {
        return ImagingError(header, "its voxels are in '" + name.substr(0, 256) + "', which " + reason);
    };
    if (name.empty() || name.find('\0') != std::string::npos || !given.has_filename())
        throw refuse("is no name of a file");
    if (given.is_absolute() || std::find(given.begin(), given.end(), "..") != given.end())
        throw refuse("leads out of the header's folder; put the file beside it");
    const std::filesystem::path file = header.parent_path() / given;
    std::error_code failed;
    const std::filesystem::file_status status = std::filesystem::status(file, failed);
    if (!std::filesystem::exists(status)) throw refuse("is not there");
    if (!std::filesystem::is_regular_file(status)) throw refuse("is not a file");
    // A link beside the header may still lead elsewhere.
    if (!lies_inside(file, header.parent_path()))
        throw refuse("is a link that leads out of the header's folder; put the file beside it");
    return file;
}

void read_voxel_data(const VoxelData& data, const TakeBytes& take) {
    std::vector<std::byte> piece(piece_bytes);
    for (const VoxelPart& part : data.parts) {
        ByteSource source(std::make_shared<const InputFile>(part.file), part.begin, data.encoding);
        source.skip(part.skipped_bytes);
        if (data.encoding == Encoding::text) {
            while (const std::size_t read = source.read_some(piece)) take(std::span(piece).first(read));
            take(std::as_bytes(std::span(" ", 1)));
            continue;
        }
        for (std::uint64_t left = part.bytes; left > 0;) {
            const auto now =
                std::span(piece).first(static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), left)));
            source.read(now);
            take(now);
            left -= now.size();
        }
        source.finish();
    }
}

std::uint64_t require_room(const VoxelData& data) {
    std::uint64_t more = 0;
    for (const VoxelPart& part : data.parts) {
        const InputFile file(part.file);
        if (is_compressed(data.encoding)) {
            require_no_bomb(file, part);
            continue;
        }
        require_bytes(file, part);
        if (data.encoding != Encoding::raw) continue;
        more = bytes_there(file, part) - part.bytes;
        if (more > 0 && data.parts.size() > 1)
            throw ImagingError(part.file, fmt::format("holds {} bytes, where {} make its slice of the image",
                                                      bytes_there(file, part), part.bytes));
    }
    return more;
}

}  // namespace osteomill
