#include "haptic_server/imaging/voxel_data.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/regular_file.h"

namespace osteomill {

namespace {

constexpr std::size_t piece_bytes = 1u << 18;
/// Deflate shrinks nothing more than 1032 times; a scan, even of labels, is far from that.
constexpr std::uint64_t most_shrunk = 500;
constexpr std::uint64_t suspicious_bytes = std::uint64_t{1} << 30U;

/// zlib's stream of one file, from an offset to its end.
class Inflater {
  public:
    Inflater(const RegularFile& file, const VoxelPart& part, VoxelEncoding encoding)
        : file_(file), part_(part), offset_(part.begin), encoded_(piece_bytes), decoded_(piece_bytes) {
        // 15 bits of window; 16 more: gzip only, 32 more: zlib or gzip, whichever begins.
        const int window = 15 + (encoding == VoxelEncoding::gzip ? 16 : 32);
        if (inflateInit2(&stream_, window) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void run(const TakeBytes& take) {
        std::uint64_t total = 0;
        for (bool ended = false; !ended;) {
            refill();
            stream_.next_out = decoded_.data();
            stream_.avail_out = static_cast<unsigned>(decoded_.size());
            const int result = inflate(&stream_, Z_NO_FLUSH);
            const std::size_t made = decoded_.size() - stream_.avail_out;
            if (result == Z_DATA_ERROR || result == Z_NEED_DICT || result == Z_STREAM_ERROR)
                throw ImagingError(part_.file,
                                   "its compressed voxels are damaged (their checksum or their coding)");
            if (result == Z_MEM_ERROR) throw std::bad_alloc();
            if (result == Z_BUF_ERROR && made == 0)
                throw ImagingError(part_.file, fmt::format("is cut off: its compressed voxels end after {} "
                                                           "of {} bytes",
                                                           total, part_.bytes));
            total += made;
            if (total > part_.bytes)
                throw ImagingError(
                    part_.file,
                    fmt::format("holds more than the {} bytes of voxels that its header says", part_.bytes));
            if (made > 0 && take) take({decoded_.data(), made});
            if (result == Z_STREAM_END) ended = !another_member();
        }
        if (total < part_.bytes)
            throw ImagingError(part_.file, fmt::format("is cut off: {} of {} bytes of voxels are there",
                                                       total, part_.bytes));
    }

  private:
    void refill() {
        if (stream_.avail_in > 0) return;
        const std::size_t count = file_.read_at(offset_, encoded_);
        offset_ += count;
        stream_.next_in = encoded_.data();
        stream_.avail_in = static_cast<unsigned>(count);
    }
    /// gzip allows one member behind the other; anything else there is refused.
    bool another_member() {
        refill();
        if (stream_.avail_in == 0) return false;
        if (*stream_.next_in != 0x1f)
            throw ImagingError(part_.file, fmt::format("has {} bytes of something else behind its voxels",
                                                       stream_.avail_in + file_.size() - offset_));
        if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
        return true;
    }

    const RegularFile& file_;
    const VoxelPart& part_;
    std::uint64_t offset_;
    std::vector<std::uint8_t> encoded_;
    std::vector<std::uint8_t> decoded_;
    z_stream stream_{};
};

std::uint64_t bytes_there(const RegularFile& file, const VoxelPart& part) {
    return file.size() - std::min(file.size(), part.begin);
}

void require_raw(const RegularFile& file, const VoxelPart& part) {
    if (bytes_there(file, part) < part.bytes)
        throw ImagingError(part.file, fmt::format("is cut off: {} of {} bytes of voxels are there",
                                                  bytes_there(file, part), part.bytes));
}

void require_no_bomb(const RegularFile& file, const VoxelPart& part) {
    if (part.bytes > suspicious_bytes && part.bytes / most_shrunk > bytes_there(file, part))
        throw ImagingError(part.file, fmt::format("says that {} bytes hold {} bytes of voxels; no scan "
                                                  "compresses so",
                                                  bytes_there(file, part), part.bytes));
}

void copy_raw(const RegularFile& file, const VoxelPart& part, const TakeBytes& take) {
    require_raw(file, part);
    std::vector<std::uint8_t> piece(piece_bytes);
    for (std::uint64_t done = 0; done < part.bytes;) {
        const auto wanted =
            static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), part.bytes - done));
        if (file.read_at(part.begin + done, {piece.data(), wanted}) != wanted)
            throw ImagingError(part.file, "was cut off while it was read");
        take({piece.data(), wanted});
        done += wanted;
    }
}

}  // namespace

std::string numbered_name(std::string_view pattern, std::int64_t number) {
    const auto refuse = [&] {
        return std::invalid_argument(fmt::format(
            "the file pattern '{}': it must hold one number and no other %, such as slice%03d.raw", pattern));
    };
    // As long as a path may be, of as many slices as there may be, would fill the memory.
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
    const std::filesystem::path folder =
        std::filesystem::canonical(header.has_parent_path() ? header.parent_path() : ".", failed);
    const std::filesystem::path real = failed ? file : std::filesystem::canonical(file, failed);
    const auto [folder_end, unused] = std::mismatch(folder.begin(), folder.end(), real.begin(), real.end());
    if (failed || folder_end != folder.end())
        throw refuse("is a link that leads out of the header's folder; put the file beside it");
    return file;
}

void read_voxel_data(const VoxelData& data, const TakeBytes& take) {
    for (const VoxelPart& part : data.parts) {
        const RegularFile file(part.file);
        switch (data.encoding) {
            case VoxelEncoding::raw:
                copy_raw(file, part, take);
                break;
            case VoxelEncoding::text:
                throw ImagingError(part.file, "its voxels are text, which is not read");
            default:
                Inflater(file, part, data.encoding).run(take);
        }
    }
}

std::uint64_t require_whole(const VoxelData& data) {
    std::uint64_t more = 0;
    for (const VoxelPart& part : data.parts) {
        const RegularFile file(part.file);
        if (data.encoding == VoxelEncoding::gzip || data.encoding == VoxelEncoding::zlib_or_gzip) {
            require_no_bomb(file, part);
            Inflater(file, part, data.encoding).run({});
            continue;
        }
        require_raw(file, part);
        if (data.encoding == VoxelEncoding::text) continue;
        more = bytes_there(file, part) - part.bytes;
        if (more > 0 && data.parts.size() > 1)
            throw ImagingError(part.file, fmt::format("holds {} bytes, where {} make its slice of the image",
                                                      bytes_there(file, part), part.bytes));
    }
    return more;
}

}  // namespace osteomill
