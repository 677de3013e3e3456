// The reports that haptic arms of the WoodenHaptics and Polhem family exchange over USB HID. They are not
// numbered; every field is a little-endian int16.
//
//   first generation, 8 bytes     in   counts a b c, debug
//                                 out  currents a b c (mA), debug
//   second generation, 14 bytes   in   counts a b c (arm), d e f (stylus), info
//                                 out  currents a b c (mA), command, attributes 0 1 2
//
// The switch on the stylus is coded into count d: 10 000 is added while it is pressed. info 1 asks to be
// calibrated and stays until that is done. Command 0 drives the motors; command 1 sets the counters, a b c
// from the attributes, d e f from the current fields.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace osteomill {

enum class ArmGeneration { first, second };

constexpr std::size_t report_bytes(ArmGeneration generation) {
    return generation == ArmGeneration::first ? 8 : 14;
}

struct ArmInput {
    ArmGeneration generation = ArmGeneration::second;
    std::array<int, 3> arm_counts{};     ///< a, b, c, as the device has them
    std::array<int, 3> stylus_counts{};  ///< d, e, f, without the switch
    bool is_switch_pressed = false;
    bool asks_for_calibration = false;
};

/// The generation shows in the length. Nothing for a report of another length, or with an info that is
/// neither 0 nor 1. Real-time safe.
std::optional<ArmInput> decode_arm_report(std::span<const std::uint8_t> report) noexcept;

/// The bytes for hidapi: a zero byte for "not numbered", then the report.
struct ArmOutput {
    std::array<std::uint8_t, 15> storage{};
    std::size_t size = 0;

    std::span<const std::uint8_t> bytes() const { return {storage.data(), size}; }
};

/// No current leaves this file that is larger: the amplifiers' 2 A.
inline constexpr int most_current_ma = 1999;

/// Drives the motors a, b, c; each current is capped at +-most_current_ma. Real-time safe.
ArmOutput currents_report(ArmGeneration generation, const std::array<int, 3>& currents_ma) noexcept;

/// Second generation only: sets the counters of the arm, and those of the stylus to zero. Counts beyond an
/// int16 are capped. The motors are without current. Real-time safe.
ArmOutput counters_report(const std::array<int, 3>& arm_counts) noexcept;

}  // namespace osteomill
