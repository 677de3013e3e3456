#include "common/igtl/igtl_stream.h"

#include <openigtlink/igtl_header.h>
#include <openigtlink/igtl_string.h>
#include <openigtlink/igtl_util.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

namespace osteomill {

namespace {

/// The protocol's version; newer OpenIGTLink names its field otherwise.
template <typename Header>
auto version_of(const Header& header) {
    if constexpr (requires { header.version; })
        return header.version;
    else
        return header.header_version;
}

constexpr std::uint16_t newest_version = 3;
constexpr std::size_t extended_header_bytes = 12;
static_assert(IgtlStream::longest_name == IGTL_HEADER_NAME_SIZE);

/// A field of fixed width; nothing if it is no printable text.
template <std::size_t width>
std::optional<std::string> text_of(const char (&field)[width]) {
    const std::string text(field, std::find(field, field + width, '\0'));
    const bool is_plain = std::all_of(
        text.begin(), text.end(), [](char c) { return std::isprint(static_cast<unsigned char>(c)) != 0; });
    return is_plain ? std::optional(text) : std::nullopt;
}

/// Sets the parts of a body in `message`, without the extended header of protocol 2 and later. False if
/// sizes contradict each other.
bool set_parts(IgtlMessageView& message, std::span<const std::uint8_t> body, std::uint16_t version) {
    message.content = body;
    message.metadata_header = message.metadata = {};
    if (version < 2) return true;
    if (body.size() < extended_header_bytes) return false;
    const std::uint64_t before = number_at(body, 0, 2);
    const std::uint64_t header_bytes = number_at(body, 2, 2);
    const std::uint64_t after = header_bytes + number_at(body, 4, 4);
    if (before < extended_header_bytes || before + after > body.size()) return false;
    const std::span<const std::uint8_t> behind = body.last(after);
    message.content = body.subspan(before, body.size() - before - after);
    message.metadata_header = behind.first(header_bytes);
    message.metadata = behind.subspan(header_bytes);
    return true;
}

}  // namespace

std::uint64_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t width) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes.subspan(at, width)) value = value << 8U | byte;
    return value;
}

std::optional<std::string> text_of_string_message(std::span<const std::uint8_t> content) {
    if (content.size() < IGTL_STRING_HEADER_SIZE ||
        number_at(content, 2, 2) != content.size() - IGTL_STRING_HEADER_SIZE)
        return std::nullopt;
    const std::span<const std::uint8_t> text = content.subspan(IGTL_STRING_HEADER_SIZE);
    return std::string(text.begin(), text.end());
}

IgtlStream::IgtlStream(Sinks sinks) : sinks_(std::move(sinks)) {
    message_.reserve(IGTL_HEADER_SIZE + longest_read_bytes);
}

void IgtlStream::restart() {
    message_.clear();
    body_left_ = 0;
    has_header_ = false;
}

bool IgtlStream::feed(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        std::size_t taken = 0;
        if (!has_header_) {
            taken = std::min(bytes.size(), IGTL_HEADER_SIZE - message_.size());
            message_.insert(message_.end(), bytes.begin(),
                            bytes.begin() + static_cast<std::ptrdiff_t>(taken));
            if (message_.size() == IGTL_HEADER_SIZE && !begin_message()) return false;
        } else {
            taken = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), body_left_));
            if (is_wanted_)
                message_.insert(message_.end(), bytes.begin(),
                                bytes.begin() + static_cast<std::ptrdiff_t>(taken));
            body_left_ -= taken;
        }
        bytes = bytes.subspan(taken);
        if (has_header_ && body_left_ == 0) end_message();
    }
    return true;
}

bool IgtlStream::begin_message() {
    igtl_header header;
    std::memcpy(&header, message_.data(), sizeof header);
    igtl_header_convert_byte_order(&header);
    std::optional<std::string> type = text_of(header.name);
    std::optional<std::string> name = text_of(header.device_name);
    if (version_of(header) < 1 || version_of(header) > newest_version || !type || type->empty() || !name ||
        header.body_size > longest_skipped_bytes)
        return false;
    is_wanted_ = sinks_.wants(*type, *name);
    if (is_wanted_ && header.body_size > longest_read_bytes) {
        sinks_.damaged();
        is_wanted_ = false;
    }
    head_ = {.type = *std::move(type), .name = *std::move(name), .stamp = header.timestamp};
    version_ = version_of(header);
    crc_ = header.crc;
    body_left_ = header.body_size;
    has_header_ = true;
    return true;
}

void IgtlStream::end_message() {
    if (is_wanted_) {
        const std::span<std::uint8_t> body = std::span(message_).subspan(IGTL_HEADER_SIZE);
        if (!set_parts(head_, body, version_) || crc64(body.data(), body.size(), 0) != crc_)
            sinks_.damaged();
        else
            sinks_.take(head_);
    }
    restart();
}

}  // namespace osteomill
