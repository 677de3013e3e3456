#include "devices/tracker/transform_stream.h"

#include <openigtlink/igtl_transform.h>

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

std::string text_of(std::span<const std::uint8_t> bytes) {
    return {bytes.begin(), bytes.end()};
}

/// Whether the metadata leaves the marker seen: PlusServer writes "TransformStatus" and "TransformValid", its
/// later versions "Status". Metadata that are cut off count as absent.
bool says_seen(const IgtlMessageView& parts) {
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

bool means_down(const std::string& said) {
    std::string text = lower_case(said);
    while (!text.empty() &&
           (std::isspace(static_cast<unsigned char>(text.back())) != 0 || text.back() == '\0'))
        text.pop_back();
    return text == "1" || text == "on" || text == "true" || text == "down";
}

}  // namespace

TransformStream::TransformStream(std::string name, std::string pedal, Sinks sinks)
    : name_(std::move(name)),
      pedal_(std::move(pedal)),
      sinks_(std::move(sinks)),
      stream_({.wants = [this](const std::string& type, const std::string& who) { return wants(type, who); },
               .take = [this](const IgtlMessageView& message) { take(message); },
               .damaged = [this] { ++counts_.damaged; }}) {}

bool TransformStream::wants(const std::string& type, const std::string& name) {
    if (type == "STRING") return !pedal_.empty() && name == pedal_;
    if (type != "TRANSFORM") return false;
    if (name_.empty()) name_ = name;
    if (name != name_) ++counts_.of_other_names;
    return name == name_;
}

void TransformStream::take(const IgtlMessageView& message) {
    if (message.type == "TRANSFORM") return take_transform(message);
    if (const std::optional<std::string> text = text_of_string_message(message.content))
        sinks_.pedal(means_down(*text));
    else
        ++counts_.damaged;
}

void TransformStream::take_transform(const IgtlMessageView& message) {
    std::array<igtl_float32, 12> values{};
    static_assert(sizeof values == IGTL_TRANSFORM_SIZE);
    if (message.content.size() != sizeof values) {
        ++counts_.damaged;
        return;
    }
    std::memcpy(values.data(), message.content.data(), sizeof values);
    igtl_transform_convert_byte_order(values.data());
    glm::dmat3 turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            turn[column][row] = static_cast<double>(values[static_cast<std::size_t>(3 * column + row)]);
    TrackerSample sample{.stamp_s = seconds_of(message.stamp),
                         .position_mm = {static_cast<double>(values[9]), static_cast<double>(values[10]),
                                         static_cast<double>(values[11])}};
    if (!is_rotation(turn) || !is_place(sample.position_mm)) {
        ++counts_.damaged;
        return;
    }
    if (!says_seen(message) || (turn == glm::dmat3(1.0) && sample.position_mm == glm::dvec3(0.0))) {
        ++counts_.hidden;
        return;
    }
    sample.turn = glm::normalize(glm::quat_cast(turn));
    ++counts_.samples;
    sinks_.sample(sample);
}

}  // namespace osteomill
