#include "devices/tracker/transform_stream.h"

#include <openigtlink/igtl_header.h>
#include <openigtlink/igtl_string.h>
#include <openigtlink/igtl_transform.h>
#include <openigtlink/igtl_util.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>

#include "common/bone/patient_space.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::uint16_t newest_version = 3;
constexpr std::size_t extended_header_bytes = 12;
static_assert(TransformStream::longest_name == IGTL_HEADER_NAME_SIZE);

/// A field of fixed width; nothing where it is no printable text.
template <std::size_t width>
std::optional<std::string> text_of(const char (&field)[width]) {
    const std::string text(field, std::find(field, field + width, '\0'));
    const bool is_plain = std::all_of(
        text.begin(), text.end(), [](char c) { return std::isprint(static_cast<unsigned char>(c)) != 0; });
    return is_plain ? std::optional(text) : std::nullopt;
}

/// Big endian, as all of OpenIGTLink.
std::uint64_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t width) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes.subspan(at, width)) value = value << 8U | byte;
    return value;
}

/// Of a message's body.
struct Parts {
    std::span<const std::uint8_t> content;
    std::span<const std::uint8_t> metadata_header{};
    std::span<const std::uint8_t> metadata{};
};

/// Without the extended header of protocol 2 and later. Nothing where sizes contradict each other.
std::optional<Parts> parts_of(std::span<const std::uint8_t> body, std::uint16_t version) {
    if (version < 2) return Parts{body};
    if (body.size() < extended_header_bytes) return std::nullopt;
    const std::uint64_t before = number_at(body, 0, 2);
    const std::uint64_t header_bytes = number_at(body, 2, 2);
    const std::uint64_t after = header_bytes + number_at(body, 4, 4);
    if (before < extended_header_bytes || before + after > body.size()) return std::nullopt;
    const std::span<const std::uint8_t> behind = body.last(after);
    return Parts{body.subspan(before, body.size() - before - after), behind.first(header_bytes),
                 behind.subspan(header_bytes)};
}

std::string text_of(std::span<const std::uint8_t> bytes) {
    return {bytes.begin(), bytes.end()};
}

/// Whether the metadata leaves the marker seen: PlusServer writes "TransformStatus" and "TransformValid", its
/// later versions "Status". What is cut off says nothing.
bool says_seen(const Parts& parts) {
    constexpr std::size_t count_bytes = 2, entry_bytes = 8;  // lengths of key and value, an encoding between
    if (parts.metadata_header.size() < count_bytes) return true;
    std::span<const std::uint8_t> entries = parts.metadata_header.subspan(count_bytes);
    std::span<const std::uint8_t> rest = parts.metadata;
    for (auto left = number_at(parts.metadata_header, 0, 2); left > 0 && entries.size() >= entry_bytes;
         --left) {
        const std::uint64_t key_bytes = number_at(entries, 0, 2);
        const std::uint64_t value_bytes = number_at(entries, 4, 4);
        if (key_bytes + value_bytes > rest.size()) return true;
        const std::string key = lower_case(text_of(rest.first(key_bytes)));
        const std::string value = lower_case(text_of(rest.subspan(key_bytes, value_bytes)));
        if ((key == "status" || key == "transformstatus") && value != "ok") return false;
        if (key == "transformvalid" && value != "true" && value != "1") return false;
        rest = rest.subspan(key_bytes + value_bytes);
        entries = entries.subspan(entry_bytes);
    }
    return true;
}

/// Seconds of OpenIGTLink's time: 32 bits of seconds, 32 of their fraction.
double seconds_of(std::uint64_t stamp) {
    return static_cast<double>(stamp >> 32U) + std::ldexp(static_cast<double>(stamp & 0xFFFFFFFFU), -32);
}

bool is_rotation(const glm::dmat3& turn) {
    const glm::dmat3 square = glm::transpose(turn) * turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(square[column][row] - (row == column ? 1.0 : 0.0)) <=
                  TransformStream::rotation_tolerance))
                return false;
    return glm::determinant(turn) > 0.0;
}

bool means_down(std::span<const std::uint8_t> said) {
    std::string text = lower_case(text_of(said));
    while (!text.empty() &&
           (std::isspace(static_cast<unsigned char>(text.back())) != 0 || text.back() == '\0'))
        text.pop_back();
    return text == "1" || text == "on" || text == "true" || text == "down";
}

}  // namespace

TransformStream::TransformStream(std::string name, std::string pedal, Sinks sinks)
    : name_(std::move(name)), pedal_(std::move(pedal)), sinks_(std::move(sinks)) {
    message_.reserve(IGTL_HEADER_SIZE + longest_read_bytes);
}

void TransformStream::restart() {
    message_.clear();
    body_left_ = 0;
    has_header_ = false;
}

bool TransformStream::feed(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        std::size_t taken = 0;
        if (!has_header_) {
            taken = std::min(bytes.size(), IGTL_HEADER_SIZE - message_.size());
            message_.insert(message_.end(), bytes.begin(),
                            bytes.begin() + static_cast<std::ptrdiff_t>(taken));
            if (message_.size() == IGTL_HEADER_SIZE && !begin_message()) return false;
        } else {
            taken = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), body_left_));
            if (kind_ != Kind::other)
                message_.insert(message_.end(), bytes.begin(),
                                bytes.begin() + static_cast<std::ptrdiff_t>(taken));
            body_left_ -= taken;
        }
        bytes = bytes.subspan(taken);
        if (has_header_ && body_left_ == 0) end_message();
    }
    return true;
}

bool TransformStream::begin_message() {
    igtl_header header;
    std::memcpy(&header, message_.data(), sizeof header);
    igtl_header_convert_byte_order(&header);
    const std::optional<std::string> type = text_of(header.name);
    const std::optional<std::string> name = text_of(header.device_name);
    if (header.version < 1 || header.version > newest_version || !type || type->empty() || !name ||
        header.body_size > longest_skipped_bytes)
        return false;
    kind_ = Kind::other;
    if (*type == "TRANSFORM") {
        if (name_.empty()) name_ = *name;
        if (*name == name_)
            kind_ = Kind::transform;
        else
            ++counts_.of_other_names;
    } else if (*type == "STRING" && !pedal_.empty() && *name == pedal_) {
        kind_ = Kind::pedal;
    }
    if (kind_ != Kind::other && header.body_size > longest_read_bytes) {
        ++counts_.damaged;
        kind_ = Kind::other;
    }
    version_ = header.version;
    stamp_ = header.timestamp;
    crc_ = header.crc;
    body_left_ = header.body_size;
    has_header_ = true;
    return true;
}

void TransformStream::end_message() {
    if (kind_ != Kind::other) {
        const std::span<std::uint8_t> body = std::span(message_).subspan(IGTL_HEADER_SIZE);
        const std::optional<Parts> parts = parts_of(body, version_);
        if (!parts || crc64(body.data(), body.size(), 0) != crc_)
            ++counts_.damaged;
        else
            kind_ == Kind::transform ? take_transform(parts->content, says_seen(*parts))
                                     : take_string(parts->content);
    }
    restart();
}

void TransformStream::take_transform(std::span<const std::uint8_t> content, bool is_seen) {
    std::array<igtl_float32, 12> values{};
    static_assert(sizeof values == IGTL_TRANSFORM_SIZE);
    if (content.size() != sizeof values) {
        ++counts_.damaged;
        return;
    }
    std::memcpy(values.data(), content.data(), sizeof values);
    igtl_transform_convert_byte_order(values.data());
    glm::dmat3 turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            turn[column][row] = static_cast<double>(values[static_cast<std::size_t>(3 * column + row)]);
    TrackerSample sample{.stamp_s = seconds_of(stamp_),
                         .position_mm = {static_cast<double>(values[9]), static_cast<double>(values[10]),
                                         static_cast<double>(values[11])}};
    if (!is_rotation(turn) || !is_place(sample.position_mm)) {
        ++counts_.damaged;
        return;
    }
    if (!is_seen || (turn == glm::dmat3(1.0) && sample.position_mm == glm::dvec3(0.0))) {
        ++counts_.hidden;
        return;
    }
    sample.turn = glm::normalize(glm::quat_cast(turn));
    ++counts_.samples;
    sinks_.sample(sample);
}

void TransformStream::take_string(std::span<const std::uint8_t> content) {
    if (content.size() < IGTL_STRING_HEADER_SIZE ||
        number_at(content, 2, 2) != content.size() - IGTL_STRING_HEADER_SIZE) {
        ++counts_.damaged;
        return;
    }
    sinks_.pedal(means_down(content.subspan(IGTL_STRING_HEADER_SIZE)));
}

}  // namespace osteomill
