#include "imaging/bone_file/gzip_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <thread>
#include <utility>

#include "imaging/in_parallel.h"

namespace osteomill {

namespace {

/// zlib's fast end: on CT it costs a seventh more space than the default and a fifth of the time.
constexpr int fastest_level = 1;
constexpr int raw_deflate = -15;  // window bits without a header of zlib's own
constexpr int memory_level = 8;   // zlib's default
constexpr std::size_t piece_bytes = 1u << 20;

/// Whether the same two bytes, a voxel, stand there again and again.
bool is_uniform(std::span<const std::byte> bytes) {
    return bytes.size() > 2 && std::memcmp(bytes.data(), bytes.data() + 2, bytes.size() - 2) == 0;
}

}  // namespace

struct GzipWriter::Piece {
    std::vector<std::byte> deflated{};
    std::uint32_t crc = 0;
};

/// Most of a scan is air: it is deflated once.
struct GzipWriter::UniformPiece {
    std::array<std::byte, 2> voxel{};
    std::size_t bytes = 0;
    Piece piece{};
};

GzipWriter::Piece GzipWriter::deflated(std::span<const std::byte> bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, fastest_level, Z_DEFLATED, raw_deflate, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    Piece piece;
    try {
        piece.deflated.resize(deflateBound(&stream, bytes.size()) + 16);  // and the flush's empty block
    } catch (...) {
        deflateEnd(&stream);
        throw;
    }
    auto* in = reinterpret_cast<const Bytef*>(bytes.data());
    stream.next_in = const_cast<Bytef*>(in);  // zlib only reads, but takes no pointer to const
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(piece.deflated.data());
    stream.avail_out = static_cast<uInt>(piece.deflated.size());
    deflate(&stream, Z_SYNC_FLUSH);
    piece.deflated.resize(piece.deflated.size() - stream.avail_out);
    deflateEnd(&stream);
    piece.crc = static_cast<std::uint32_t>(crc32(0, in, static_cast<uInt>(bytes.size())));
    return piece;
}

namespace {

std::size_t pieces_at_once() {
    return 2 * std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 16);
}

std::array<std::byte, 4> little_endian(std::uint32_t value) {
    return {std::byte(value), std::byte(value >> 8), std::byte(value >> 16), std::byte(value >> 24)};
}

}  // namespace

GzipWriter::~GzipWriter() = default;

GzipWriter::GzipWriter(Write write) : write_(std::move(write)), room_bytes_(pieces_at_once() * piece_bytes) {
    // Magic, deflate, no flags, no time stamp, fast, Unix.
    constexpr std::array<std::byte, 10> header{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}, std::byte{0},
                                               std::byte{0},    std::byte{0},    std::byte{0}, std::byte{0},
                                               std::byte{4},    std::byte{3}};
    write_(header);
    waiting_.reserve(room_bytes_);
}

void GzipWriter::add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const std::size_t taken = std::min(bytes.size(), room_bytes_ - waiting_.size());
        waiting_.insert(waiting_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
        bytes = bytes.subspan(taken);
        if (waiting_.size() == room_bytes_) compress_waiting();
    }
}

const GzipWriter::Piece& GzipWriter::uniform(std::span<const std::byte> bytes) {
    const std::array<std::byte, 2> voxel{bytes[0], bytes[1]};
    if (!uniform_ || uniform_->voxel != voxel || uniform_->bytes != bytes.size())
        uniform_ = std::make_unique<UniformPiece>(
            UniformPiece{.voxel = voxel, .bytes = bytes.size(), .piece = deflated(bytes)});
    return uniform_->piece;
}

void GzipWriter::compress_waiting() {
    const std::size_t count = (waiting_.size() + piece_bytes - 1) / piece_bytes;
    std::vector<Piece> pieces(count);
    const auto bytes_of = [&](std::size_t i) {
        return std::span<const std::byte>(waiting_).subspan(
            i * piece_bytes, std::min(piece_bytes, waiting_.size() - i * piece_bytes));
    };
    std::vector<std::size_t> various;
    for (std::size_t i = 0; i < count; ++i) {
        if (is_uniform(bytes_of(i))) {
            pieces[i] = uniform(bytes_of(i));
        } else {
            various.push_back(i);
        }
    }
    in_parallel(static_cast<int>(various.size()), [&](int i) {
        const std::size_t at = various[static_cast<std::size_t>(i)];
        pieces[at] = deflated(bytes_of(at));
    });
    for (std::size_t i = 0; i < count; ++i) {
        crc_ = static_cast<std::uint32_t>(
            crc32_combine(crc_, pieces[i].crc, static_cast<z_off_t>(bytes_of(i).size())));
        write_(pieces[i].deflated);
    }
    length_ += waiting_.size();
    waiting_.clear();
}

void GzipWriter::finish() {
    compress_waiting();
    constexpr std::array<std::byte, 2> last_block{std::byte{3}, std::byte{0}};  // deflate's empty last block
    write_(last_block);
    write_(little_endian(crc_));
    write_(little_endian(static_cast<std::uint32_t>(length_)));
}

}  // namespace osteomill
