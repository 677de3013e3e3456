// Frames: protobuf messages in a byte stream, each behind its length as a varint (protobuf's own "delimited"
// form).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace google::protobuf {
class MessageLite;
}  // namespace google::protobuf

namespace osteomill {

/// Reason why something that came over the wire was refused: one line for people, fit for a log.
struct WireError {
    std::string line{};
};

/// The largest message in a frame. It bounds the memory that either side holds for a peer that it does not
/// trust, and how long one frame keeps the next waiting; a snapshot is cut to fit.
inline constexpr std::size_t largest_frame_bytes = 128 * 1024;

/// The largest that a client may send: it sends far less than a server.
inline constexpr std::size_t largest_client_frame_bytes = 8 * 1024;

/// Appends one frame. Throws std::length_error for a message over the limit: the sender is to cut it first.
void append_frame(const google::protobuf::MessageLite& message, std::string& stream);
/// Does the same with a message that has been serialised.
void append_frame(std::string_view message, std::string& stream);

/// Finds the frames in a stream that arrives in pieces of any size. It holds bytes that have arrived and were
/// not yet read, and never allocates because of a peer's claim.
class FrameDecoder {
  public:
    FrameDecoder() = default;
    /// For a peer that has no use for frames as long as largest_frame_bytes.
    explicit FrameDecoder(std::size_t largest_bytes) : largest_bytes_(largest_bytes) {}

    /// Takes over bytes as they arrived. Take all frames with next() before the next append.
    void append(std::span<const std::uint8_t> bytes);

    /// The message bytes of the next complete frame, or nothing: more must arrive first, or see error(). The
    /// view holds until the next call.
    std::optional<std::span<const std::uint8_t>> next();

    /// One line once the stream makes no sense (a frame over the limit, an empty one, a length that is no
    /// varint); empty while all is well. Nothing is found in a stream after that.
    const std::string& error() const { return error_; }

    /// Whether a frame has begun to arrive and is not complete: at the end of a stream, that it was cut.
    bool is_inside_frame() const { return taken_ < buffer_.size(); }

  private:
    std::size_t largest_bytes_ = largest_frame_bytes;
    std::vector<std::uint8_t> buffer_;
    std::size_t taken_ = 0;  // bytes at the front of the buffer that next() has handed out
    std::string error_;
};

// Parsing of a message that came from outside.

/// False if the bytes are no such message; the caller reports the error. protobuf by itself would write a
/// line to standard error for each text that is not UTF-8, and an untrusted peer could fill a log with them.
bool parse_message(std::span<const std::uint8_t> bytes, google::protobuf::MessageLite& message);

}  // namespace osteomill
