#include "devices/hid/arm_report.h"

#include <algorithm>
#include <limits>

namespace osteomill {

namespace {

/// The pressed switch adds the offset to count d, which is then above the threshold.
constexpr int switch_threshold = 5000;
constexpr int switch_offset = 10'000;

constexpr std::size_t info_field = 6;
constexpr std::size_t command_field = 3;
constexpr std::size_t first_attribute_field = 4;
constexpr int set_counters = 1;

int field(std::span<const std::uint8_t> report, std::size_t index) noexcept {
    const auto bits = static_cast<std::uint16_t>(report[2 * index] | report[2 * index + 1] << 8);
    return static_cast<std::int16_t>(bits);
}

void set_field(ArmOutput& output, std::size_t index, int value) noexcept {
    using Limits = std::numeric_limits<std::int16_t>;
    const int capped = std::clamp<int>(value, Limits::min(), Limits::max());
    const auto bits = static_cast<std::uint16_t>(static_cast<std::int16_t>(capped));
    output.storage[1 + 2 * index] = static_cast<std::uint8_t>(bits & 0xFF);
    output.storage[2 + 2 * index] = static_cast<std::uint8_t>(bits >> 8);
}

}  // namespace

std::optional<ArmInput> decode_arm_report(std::span<const std::uint8_t> report) noexcept {
    ArmInput input;
    if (report.size() == report_bytes(ArmGeneration::first)) {
        input.generation = ArmGeneration::first;
    } else if (report.size() != report_bytes(ArmGeneration::second)) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < 3; ++i) input.arm_counts[i] = field(report, i);
    if (input.generation == ArmGeneration::first) return input;

    for (std::size_t i = 0; i < 3; ++i) input.stylus_counts[i] = field(report, 3 + i);
    if (input.stylus_counts[0] > switch_threshold) {
        input.stylus_counts[0] -= switch_offset;
        input.is_switch_pressed = true;
    }
    const int info = field(report, info_field);
    if (info != 0 && info != 1) return std::nullopt;
    input.asks_for_calibration = info == 1;
    return input;
}

ArmOutput currents_report(ArmGeneration generation, const std::array<int, 3>& currents_ma) noexcept {
    ArmOutput output;
    output.size = 1 + report_bytes(generation);
    for (std::size_t i = 0; i < 3; ++i)
        set_field(output, i, std::clamp(currents_ma[i], -most_current_ma, most_current_ma));
    return output;
}

ArmOutput counters_report(const std::array<int, 3>& arm_counts) noexcept {
    ArmOutput output;
    output.size = 1 + report_bytes(ArmGeneration::second);
    set_field(output, command_field, set_counters);
    for (std::size_t i = 0; i < 3; ++i) set_field(output, first_attribute_field + i, arm_counts[i]);
    return output;
}

}  // namespace osteomill
