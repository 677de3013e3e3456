// Parsing of a message that came from outside.
#pragma once

#include <cstdint>
#include <span>

namespace google::protobuf {
class MessageLite;
}

namespace osteomill {

/// False if the bytes are no such message; the caller reports the error. protobuf by itself would write a
/// line to standard error for each text that is not UTF-8, and a stranger could fill a log with them.
bool parse_message(std::span<const std::uint8_t> bytes, google::protobuf::MessageLite& message);

}  // namespace osteomill
