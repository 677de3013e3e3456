// Command of an operator without an arm, the one type for it from the mouse to the device.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace osteomill {

/// For a server that runs with --device client. On the wire it is the message OperatorInput.
struct OperatorCommand {
    glm::dvec3 hand_target_mm{0.0};      ///< patient LPS
    glm::dvec3 spindle_axis{0, 0, 1.0};  ///< from tip to shank; any length above zero
    bool pedal = false;                  ///< spindle on while true
    std::size_t burr = 0;                ///< index into the session's burrs
    bool operator==(const OperatorCommand&) const = default;
};

// Limits on the targets of an operator's hand. The server enforces them for every client, in its haptic tick.
// A client also keeps its own target within reach, so that a mouse that turns back moves the tool at once.

/// Greatest distance of the target from the burr, at the arm (ArmScale). Beyond it a hand could no longer
/// feel its position; the coupling's spring is long saturated.
inline constexpr double longest_reach_mm = 6.0;

/// No hand moves an arm faster.
inline constexpr double fastest_hand_mm_per_s = 500.0;

}  // namespace osteomill
