#include "common/wire/sealed_frame.h"

#include <xxhash.h>

#include "common/wire/frame.h"
#include "common/wire/parse_message.h"

namespace osteomill {

namespace {

constexpr std::uint8_t seal_tag = v1::ServerFrame::kFrameChecksumFieldNumber << 3U | 5U;  // 5: fixed32

std::uint32_t checksum_of(const void* bytes, std::size_t size) {
    return static_cast<std::uint32_t>(XXH3_64bits(bytes, size));
}

}  // namespace

void append_sealed_frame(const v1::ServerFrame& frame, std::string& stream) {
    std::string message = frame.SerializeAsString();
    // Messages behind one another are one message with the fields of both.
    v1::ServerFrame seal;
    seal.set_frame_checksum(checksum_of(message.data(), message.size()));
    seal.AppendToString(&message);
    append_frame(message, stream);
}

std::variant<v1::ServerFrame, WireError> open_frame(std::span<const std::uint8_t> message, Seal seal) {
    v1::ServerFrame frame;
    if (!parse_message(message, frame)) return WireError{"a frame is no message"};
    if (!frame.has_frame_checksum()) {
        if (seal == Seal::required) return WireError{"a frame lacks its checksum"};
        return frame;
    }
    if (message.size() < seal_bytes || message[message.size() - seal_bytes] != seal_tag)
        return WireError{"a frame's checksum is not its last field"};
    if (frame.frame_checksum() != checksum_of(message.data(), message.size() - seal_bytes))
        return WireError{"a frame's checksum does not hold"};
    return frame;
}

}  // namespace osteomill
