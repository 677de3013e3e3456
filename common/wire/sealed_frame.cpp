#include "common/wire/sealed_frame.h"

#include <xxhash.h>

#include "common/wire/frame.h"

namespace osteomill {

namespace {

constexpr std::uint8_t seal_tag = v2::ServerFrame::kFrameChecksumFieldNumber << 3U | 5U;  // 5: fixed32

std::uint32_t checksum_of(const void* bytes, std::size_t size) {
    return static_cast<std::uint32_t>(XXH3_64bits(bytes, size));
}

/// Messages behind one another are one message with the fields of both.
void append_seal(std::string& message) {
    v2::ServerFrame seal;
    seal.set_frame_checksum(checksum_of(message.data(), message.size()));
    seal.AppendToString(&message);
}

bool ends_in_seal(std::span<const std::uint8_t> message) {
    return message.size() >= seal_bytes && message[message.size() - seal_bytes] == seal_tag;
}

}  // namespace

void append_sealed_frame(const v2::ServerFrame& frame, std::string& stream) {
    std::string message = frame.SerializeAsString();
    append_seal(message);
    append_frame(message, stream);
}

bool has_sound_seal(std::span<const std::uint8_t> message) {
    if (!ends_in_seal(message)) return false;
    std::uint32_t stated = 0;
    for (std::size_t i = 0; i < 4; ++i) stated |= std::uint32_t{message[message.size() - 4 + i]} << (8 * i);
    return stated == checksum_of(message.data(), message.size() - seal_bytes);
}

std::string with_recorded_time(std::span<const std::uint8_t> sealed_message, std::int64_t unix_ns) {
    std::string message(sealed_message.begin(), sealed_message.end() - seal_bytes);
    v2::ServerFrame time;
    time.set_recorded_unix_ns(unix_ns);
    time.AppendToString(&message);
    append_seal(message);
    return message;
}

std::variant<v2::ServerFrame, WireError> open_frame(std::span<const std::uint8_t> message) {
    v2::ServerFrame frame;
    if (!parse_message(message, frame)) return WireError{"a frame is no message"};
    if (!frame.has_frame_checksum()) return WireError{"a frame lacks its checksum"};
    if (!ends_in_seal(message)) return WireError{"a frame's checksum is not its last field"};
    if (!has_sound_seal(message)) return WireError{"a frame's checksum does not hold"};
    return frame;
}

}  // namespace osteomill
