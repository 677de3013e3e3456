// One tick of the haptic loop as logs and recordings keep it: a table of quantities, each with its number of
// decimals.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "common/scene/fixture.h"

namespace osteomill {

/// Input of a tick besides the hand's pose.
struct TickInput {
    /// In the order of their numbers in recordings.
    enum class Pedal : std::uint8_t {
        up,
        down,
        waiting,  ///< down, and does not count yet
        lapsed,   ///< nothing is known of it lately
        no_hand,  ///< nor of the hand: the device is lost
    };
    Pedal pedal = Pedal::up;
    std::optional<std::size_t> burr{};  ///< of the session's, that is asked for
    bool lets_go = false;               ///< the session ends: force and spindle go
    std::uint64_t steps = 0;            ///< of the milling loop, that it was the first to see (seen_steps.h)
    bool holds_still = false;           ///< somebody wants it, as in a pause
    FixtureSet switched = 0;            ///< fixtures that are not on or off as the scene says
    std::uint32_t chosen_rpm = 0;       ///< the spindle's speed; 0: each burr's own
    bool is_placed = false;             ///< the tool was moved to this pose while the hand stayed
    std::uint32_t restored = 0;         ///< bricks that undo gave back, up to the next tick

    bool operator==(const TickInput&) const = default;
};

/// Positions and directions in patient LPS. Those of the hand have the decimals of written_pose.h.
struct TickSample {
    double time_s = 0.0;  ///< session time
    glm::dvec3 hand_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};  ///< on the hand
    /// Depth of the burr's lowest point below where it first met bone, along the spindle axis of that moment;
    /// 0 before.
    double depth_mm = 0.0;
    double removed_mm3 = 0.0;  ///< since the start, or the first session of a bone that was carved before
    bool spindle_on = false;
    std::uint8_t fault = 0;                  ///< number of a Fault (fault.h); 0 while all is well
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, from tip to shank
    std::size_t burr = 0;                    ///< index into the session's burrs
    std::optional<glm::dvec3>
        shank_torque_n_mm{};  ///< of bone on the shank about the burr's centre; absent: no burr has one
    /// With it the tick can be computed again. Absent in an older recording, whose poses are rounded to 0.1
    /// um.
    std::optional<TickInput> input{};

    /// The first line of a log, for ticks with or without a torque of the shank.
    static std::string header_line(bool has_torque = false);
    /// Its line of a log.
    void append_to(fmt::memory_buffer& text) const;
    /// Ticks that may wait between two drains: 8 s.
    static constexpr std::size_t capacity = 8192;

    bool operator==(const TickSample&) const = default;
};

/// Condition under which a tick has a quantity.
enum class TickPart : std::uint8_t {
    always,
    torque,   ///< where a burr has a shank
    input,    ///< where TickInput is known; readers of before do not know of it
    control,  ///< the same: how the session was controlled; recordings leave zeros out
    rest,     ///< the same: missing decimals of the hand's pose, which setting it adds
};

/// One number of a tick. A log's columns are those that are `in_log`, in this order.
struct TickQuantity {
    const char* name;  ///< with its unit; the log's column
    const char* unit;  ///< "1": none
    int decimals;      ///< that recordings keep
    int log_decimals;  ///< that logs keep
    bool in_log;
    TickPart part;
    double (*of)(const TickSample& tick);
    void (*set)(TickSample& tick, double value);

    /// Whether ticks like this one have it.
    bool is_of(const TickSample& tick) const {
        switch (part) {
            case TickPart::always:
                break;
            case TickPart::torque:
                return tick.shank_torque_n_mm.has_value();
            case TickPart::input:
            case TickPart::control:
            case TickPart::rest:
                return tick.input.has_value();
        }
        return true;
    }
};

/// All of them, in the order of recordings.
std::span<const TickQuantity> tick_quantities();

// Numbers with a fixed number of decimals as whole numbers of the last one, as logs round and recordings pack
// them.

/// Codes up to here, and the differences of two of them, are exact in a double.
inline constexpr double largest_decimal_code = 1e15;

/// The whole number of a value's last decimal, of 0 to 9: rounded as fmt::format rounds it, half to even.
/// Minus zero has a code of its own, -1, since a log tells it from zero; -1 has the code -2. Values beyond
/// 1e15, and NaN, become 1e15.
std::int64_t to_code(double value, int decimals);
double from_code(std::int64_t code, int decimals);

}  // namespace osteomill
