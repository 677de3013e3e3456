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

}  // namespace osteomill
