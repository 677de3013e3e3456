#include "common/wire/frame.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message_lite.h>
#include <google/protobuf/stubs/logging.h>

#include <stdexcept>

namespace osteomill {

namespace {

constexpr std::size_t longest_prefix_bytes = 3;  // 7 bits a byte: enough for largest_frame_bytes
static_assert(largest_frame_bytes < (std::size_t{1} << (7 * longest_prefix_bytes)));

}  // namespace

void append_frame(const google::protobuf::MessageLite& message, std::string& stream) {
    append_frame(message.SerializeAsString(), stream);
}

void append_frame(std::string_view message, std::string& stream) {
    if (message.empty() || message.size() > largest_frame_bytes)
        throw std::length_error("a message of " + std::to_string(message.size()) +
                                " bytes does not fit a frame of 1 to " + std::to_string(largest_frame_bytes));
    google::protobuf::io::StringOutputStream output(&stream);
    google::protobuf::io::CodedOutputStream coded(&output);
    coded.WriteVarint32(static_cast<std::uint32_t>(message.size()));
    coded.WriteRaw(message.data(), static_cast<int>(message.size()));
}

void FrameDecoder::append(std::span<const std::uint8_t> bytes) {
    if (!error_.empty()) return;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(taken_));
    taken_ = 0;
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

std::optional<std::span<const std::uint8_t>> FrameDecoder::next() {
    if (!error_.empty()) return std::nullopt;
    const std::span<const std::uint8_t> waiting = std::span(buffer_).subspan(taken_);
    std::size_t size = 0;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        if (i == longest_prefix_bytes) {
            error_ = "a frame claims to be longer than " + std::to_string(largest_bytes_) + " bytes";
            return std::nullopt;
        }
        size |= static_cast<std::size_t>(waiting[i] & 0x7FU) << (7 * i);
        if (waiting[i] & 0x80U) continue;

        const std::size_t prefix = i + 1;
        if (size > largest_bytes_)
            error_ = "a frame claims " + std::to_string(size) + " bytes, over the limit of " +
                     std::to_string(largest_bytes_);
        else if (size == 0)
            error_ = "a frame is empty";
        else if (i > 0 && waiting[i] == 0)
            error_ = "a frame's length is padded with zeros";
        if (!error_.empty() || waiting.size() - prefix < size) return std::nullopt;
        taken_ += prefix + size;
        return waiting.subspan(prefix, size);
    }
    return std::nullopt;
}

bool parse_message(std::span<const std::uint8_t> bytes, google::protobuf::MessageLite& message) {
    const google::protobuf::LogSilencer silence;
    return message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

}  // namespace osteomill
