// A server's frame with a checksum of its own, so that it can be trusted wherever it was kept.
//
// The checksum is the frame's last field, over the bytes before it: a reader hashes the received bytes and
// need not serialise anything again, and any protobuf tool still reads the frame as the message that it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

/// The bytes that a seal adds to a message: a tag of one byte, and 32 bits.
inline constexpr std::size_t seal_bytes = 5;

/// The bytes that a recording adds to a sealed frame: a tag of one byte, and 64 bits.
inline constexpr std::size_t recorded_time_bytes = 9;

/// Appends the frame, which is not sealed yet, with its seal, behind its length. Throws std::length_error for
/// one that does not fit: see append_frame.
void append_sealed_frame(const v2::ServerFrame& frame, std::string& stream);

/// The frame of a message's bytes. Refused: bytes that are no message, and a seal that is missing, does not
/// hold or is not the last field.
std::variant<v2::ServerFrame, WireError> open_frame(std::span<const std::uint8_t> message);

/// Whether these bytes end in a seal that holds, whatever their content.
bool has_sound_seal(std::span<const std::uint8_t> message);

/// A sealed message with the time at which it is recorded, nanoseconds since 1970, sealed anew. Call only
/// with a message that open_frame accepted as sealed.
std::string with_recorded_time(std::span<const std::uint8_t> sealed_message, std::int64_t unix_ns);

}  // namespace osteomill
