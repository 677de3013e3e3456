// Parsing of a message that came from outside.
#pragma once

#include <cstdint>
#include <span>

namespace google::protobuf {
class MessageLite;
}

namespace osteomill {

/// False where the bytes are no such message; what is wrong is then the caller's to say. protobuf by itself
/// would write a line to standard error for each text that is no UTF-8: a stranger could fill a log with
/// them.
bool parse_message(std::span<const std::uint8_t> bytes, google::protobuf::MessageLite& message);

}  // namespace osteomill
