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

namespace osteomill {

/// Positions and directions in patient LPS.
struct TickSample {
    double time_s = 0.0;  ///< session time
    glm::dvec3 hand_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};  ///< on the hand
    /// Of the burr's lowest point below where it first met bone, along the spindle axis of that moment; 0
    /// before.
    double depth_mm = 0.0;
    double removed_mm3 = 0.0;  ///< since the start, or the first session of a bone that was carved before
    bool spindle_on = false;
    std::uint8_t fault = 0;                  ///< number of a Fault (fault.h); 0 while all is well
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, from tip to shank
    std::size_t burr = 0;                    ///< index into the session's burrs
    std::optional<glm::dvec3>
        shank_torque_n_mm{};  ///< of bone on the shank about the burr's centre; absent: no burr has one

    /// The first line of a log, for ticks with or without a torque of the shank.
    static std::string header_line(bool has_torque = false);
    /// Its line of a log.
    void append_to(fmt::memory_buffer& text) const;
    /// Ticks that may wait between two drains: 8 s.
    static constexpr std::size_t capacity = 8192;

    bool operator==(const TickSample&) const = default;
};

/// One number of a tick. A log's columns are those that are `in_log`, in this order.
struct TickQuantity {
    const char* name;  ///< with its unit; the log's column
    const char* unit;  ///< "1": none
    int decimals;      ///< that logs and recordings keep
    bool in_log;
    double (*of)(const TickSample& tick);
    void (*set)(TickSample& tick, double value);
};

/// All of them; the last three are the torque's, for ticks that have one.
std::span<const TickQuantity> tick_quantities();
inline constexpr std::size_t torque_quantities = 3;
std::span<const TickQuantity> tick_quantities(bool has_torque);

}  // namespace osteomill
