#include "haptic_server/imaging/byte_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {
constexpr int gzip_or_zlib = 15 + 32;  // zlib's window bits for: look which it is
constexpr std::size_t buffer_bytes = 1u << 18;
constexpr std::uint64_t deflate_ratio = 1032;
}  // namespace

OpenFile::OpenFile(const std::filesystem::path& path) : path_(path) {
    // Not to wait for the other end of a pipe.
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) throw ImagingError(path, std::string("cannot be opened: ") + std::strerror(errno));
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(descriptor_);
        throw ImagingError(path, "is not a file");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

OpenFile::~OpenFile() {
    ::close(descriptor_);
}

std::size_t OpenFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got =
            ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw ImagingError(path_, std::string("cannot be read: ") + std::strerror(errno));
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

struct ByteSource::Inflater {
    Inflater() {
        if (inflateInit2(&stream, gzip_or_zlib) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    z_stream stream{};
    std::vector<std::byte> in = std::vector<std::byte>(buffer_bytes);
    bool has_ended = false;

    /// Inflates until `bytes` are full or the stream ends; how many there were.
    std::size_t inflate_into(std::span<std::byte> bytes, const OpenFile& file, std::uint64_t& offset) {
        std::size_t done = 0;
        while (done < bytes.size() || (bytes.empty() && !has_ended)) {
            if (has_ended) {
                // Another member may follow, as `cat a.gz b.gz` leaves them.
                if (!more(file, offset)) return done;
                inflateReset(&stream);
                has_ended = false;
            }
            if (!more(file, offset)) throw ImagingError(file.path(), "is cut off: its gzip data end early");
            std::byte probe[1];  // room beyond what is expected, to meet the end
            const std::size_t room = std::min<std::size_t>(bytes.size() - done, 1u << 30);
            stream.next_out = reinterpret_cast<Bytef*>(bytes.empty() ? probe : bytes.data() + done);
            stream.avail_out = bytes.empty() ? 1 : static_cast<uInt>(room);
            const uInt before = stream.avail_out;
            const int result = inflate(&stream, Z_NO_FLUSH);
            if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
                throw ImagingError(file.path(), fmt::format("its compressed voxels are damaged (gzip: {})",
                                                            stream.msg == nullptr ? "no data" : stream.msg));
            has_ended = result == Z_STREAM_END;
            const std::size_t got = before - stream.avail_out;
            if (bytes.empty() && got > 0)
                throw ImagingError(file.path(), "holds more data than its header says");
            done += got;
        }
        return done;
    }

  private:
    bool more(const OpenFile& file, std::uint64_t& offset) {
        if (stream.avail_in > 0) return true;
        const std::size_t got = file.read(offset, in);
        offset += got;
        stream.next_in = reinterpret_cast<Bytef*>(in.data());
        stream.avail_in = static_cast<uInt>(got);
        return got > 0;
    }
};

ByteSource::ByteSource(std::shared_ptr<const OpenFile> file, std::uint64_t offset, Encoding encoding)
    : file_(std::move(file)),
      offset_(offset),
      inflater_(encoding == Encoding::gzip ? std::make_unique<Inflater>() : nullptr) {}

ByteSource::~ByteSource() = default;
ByteSource::ByteSource(ByteSource&&) noexcept = default;

void ByteSource::read(std::span<std::byte> bytes) {
    if (bytes.empty()) return;
    std::size_t done = 0;
    if (inflater_) {
        done = inflater_->inflate_into(bytes, *file_, offset_);
    } else {
        done = file_->read(offset_, bytes);
        offset_ += done;
    }
    if (done < bytes.size()) throw ImagingError(file_->path(), "is cut off: its data end early");
}

void ByteSource::skip(std::uint64_t count) {
    if (!inflater_) {
        offset_ += count;
        return;
    }
    std::vector<std::byte> unread(static_cast<std::size_t>(std::min<std::uint64_t>(count, buffer_bytes)));
    while (count > 0) {
        const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, unread.size()));
        read(std::span(unread).first(now));
        count -= now;
    }
}

void ByteSource::finish() {
    if (inflater_) inflater_->inflate_into({}, *file_, offset_);
}

bool can_hold(std::uint64_t file_bytes, std::uint64_t bytes, Encoding encoding) {
    return encoding == Encoding::raw ? bytes <= file_bytes : bytes / deflate_ratio <= file_bytes;
}

}  // namespace osteomill
