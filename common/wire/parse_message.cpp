#include "common/wire/parse_message.h"

#include <google/protobuf/message_lite.h>
#include <google/protobuf/stubs/logging.h>

namespace osteomill {

bool parse_message(std::span<const std::uint8_t> bytes, google::protobuf::MessageLite& message) {
    const google::protobuf::LogSilencer silence;
    return message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

}  // namespace osteomill
