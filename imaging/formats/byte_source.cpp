#include "imaging/formats/byte_source.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>
#include <vector>

#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::size_t buffer_bytes = 1u << 18;
constexpr std::uint64_t deflate_ratio = 1032;

/// zlib's window bits: 15, and 16 more for gzip only, 32 more for whichever begins.
int window_bits(Encoding encoding) {
    return 15 + (encoding == Encoding::gzip ? 16 : 32);
}

}  // namespace

/// zlib's stream of a file.
class ByteSource::Inflater {
  public:
    Inflater(const InputFile& file, std::uint64_t offset, Encoding encoding)
        : file_(file), offset_(offset), in_(buffer_bytes) {
        if (inflateInit2(&stream_, window_bits(encoding)) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /// Until `bytes` are full or the stream ends; how many there were.
    std::size_t read(std::span<std::byte> bytes) {
        std::size_t done = 0;
        while (done < bytes.size() && !has_ended_) done += step(bytes.subspan(done));
        return done;
    }
    /// Whether the stream ends here.
    bool ends() {
        std::array<std::byte, 1> more{};
        return read(more) == 0;
    }

  private:
    std::size_t step(std::span<std::byte> bytes) {
        refill();
        const auto space = static_cast<uInt>(std::min<std::size_t>(bytes.size(), 1u << 30));
        stream_.next_out = reinterpret_cast<Bytef*>(bytes.data());
        stream_.avail_out = space;
        const int result = inflate(&stream_, Z_NO_FLUSH);
        const std::size_t made = space - stream_.avail_out;
        if (result == Z_MEM_ERROR) throw std::bad_alloc();
        if (result == Z_BUF_ERROR && made == 0)
            throw ImagingError(file_.path(), "is cut off: its compressed voxels end early");
        if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
            throw ImagingError(file_.path(), fmt::format("its compressed voxels are damaged (gzip: {})",
                                                         stream_.msg == nullptr ? "no data" : stream_.msg));
        if (result == Z_STREAM_END) has_ended_ = !another_member();
        return made;
    }
    /// Another member may follow, as `cat a.gz b.gz` leaves them, or zeros; anything else there is refused.
    bool another_member() {
        skip_zeros();
        if (stream_.avail_in == 0) return false;
        if (*stream_.next_in != 0x1f)
            throw ImagingError(file_.path(), fmt::format("has {} bytes of something else behind its voxels",
                                                         stream_.avail_in + file_.size() - offset_));
        inflateReset(&stream_);
        return true;
    }
    void skip_zeros() {
        for (refill(); stream_.avail_in > 0 && *stream_.next_in == 0; refill()) {
            ++stream_.next_in;
            --stream_.avail_in;
        }
    }
    void refill() {
        if (stream_.avail_in > 0) return;
        const std::size_t got = file_.read_at(offset_, in_);
        offset_ += got;
        stream_.next_in = reinterpret_cast<Bytef*>(in_.data());
        stream_.avail_in = static_cast<uInt>(got);
    }

    const InputFile& file_;
    std::uint64_t offset_;
    std::vector<std::byte> in_;
    z_stream stream_{};
    bool has_ended_ = false;
};

ByteSource::ByteSource(std::shared_ptr<const InputFile> file, std::uint64_t offset, Encoding encoding)
    : file_(std::move(file)),
      offset_(offset),
      encoding_(encoding),
      inflater_(is_compressed(encoding) ? std::make_unique<Inflater>(*file_, offset, encoding) : nullptr) {}

ByteSource::~ByteSource() = default;
ByteSource::ByteSource(ByteSource&&) noexcept = default;

std::size_t ByteSource::read_some(std::span<std::byte> bytes) {
    std::size_t done = 0;
    if (inflater_) {
        done = inflater_->read(bytes);
    } else {
        done = file_->read_at(offset_, bytes);
        offset_ += done;
    }
    given_ += done;
    return done;
}

void ByteSource::read(std::span<std::byte> bytes) {
    const std::size_t done = read_some(bytes);
    if (done < bytes.size())
        throw ImagingError(file_->path(),
                           fmt::format("is cut off: its data end after {} bytes, where {} are still missing",
                                       given_, bytes.size() - done));
}

void ByteSource::skip(std::uint64_t count) {
    if (encoding_ == Encoding::raw) {
        offset_ += count;
        given_ += count;
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
    if (inflater_ && !inflater_->ends())
        throw ImagingError(file_->path(),
                           fmt::format("holds more than the {} bytes that its header says", given_));
}

std::vector<std::uint8_t> first_bytes_inflated(const InputFile& file, std::size_t most) {
    std::vector<std::uint8_t> packed = file.first_bytes(std::max(most, buffer_bytes));
    const bool is_gzip = packed.size() > 1 && packed[0] == 0x1f && packed[1] == 0x8b;
    if (!is_gzip) {
        packed.resize(std::min(packed.size(), most));
        return packed;
    }
    z_stream stream{};
    if (inflateInit2(&stream, window_bits(Encoding::gzip)) != Z_OK) throw std::bad_alloc();
    std::vector<std::uint8_t> bytes(most);
    stream.next_in = packed.data();
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = bytes.data();
    stream.avail_out = static_cast<uInt>(most);
    inflate(&stream, Z_SYNC_FLUSH);
    bytes.resize(most - stream.avail_out);
    inflateEnd(&stream);
    return bytes;
}

bool can_hold(std::uint64_t file_bytes, std::uint64_t bytes, Encoding encoding) {
    return (is_compressed(encoding) ? bytes / deflate_ratio : bytes) <= file_bytes;
}

}  // namespace osteomill
