// Writer of a gzip stream (RFC 1952) on all cores.
//
// Deflated pieces that end on a byte (Z_SYNC_FLUSH) and refer to nothing before themselves follow each other
// within one member, as pigz does it: to every reader it is plain gzip. Pieces of 1 MiB cost next to nothing
// in size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace osteomill {

class GzipWriter {
  public:
    using Write = std::function<void(std::span<const std::byte>)>;

    /// `write` is called with the file's bytes, in order, from the thread that calls add and finish.
    explicit GzipWriter(Write write);

    ~GzipWriter();

    void add(std::span<const std::byte> bytes);
    /// Ends the stream with its CRC; once, and nothing may be added after it.
    void finish();

  private:
    struct Piece;
    struct UniformPiece;

    static Piece deflated(std::span<const std::byte> bytes);
    const Piece& uniform(std::span<const std::byte> bytes);
    void compress_waiting();

    Write write_;
    std::size_t room_bytes_;  // most bytes that wait; a member, because asking for the number of cores opens
                              // a file
    std::vector<std::byte> waiting_{};
    std::uint32_t crc_ = 0;
    std::uint64_t length_ = 0;
    std::unique_ptr<UniformPiece> uniform_{};  // the last that was met
};

}  // namespace osteomill
