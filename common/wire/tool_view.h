// The tool as a viewer needs it, and what an operator without an arm asks for. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "common/scene/scene.h"

namespace osteomill {

/// Which client moves the tool, as told to one of them.
enum class ToolDriver {
    unknown,  ///< no client: the server has a device of its own, or is too old to say
    nobody,   ///< the next that sends input
    you,
    another,      ///< whose lease has not run out: input is ignored
    others_only,  ///< whoever it is, not this client, which may only watch: input is ignored
};

/// What a state frame says about the tool. Positions and forces in patient LPS.
struct ToolView {
    double time_s = 0.0;                 ///< session time
    glm::dvec3 burr_position_mm{0.0};    ///< centre of the burr's sphere
    glm::dvec3 spindle_axis{0, 0, 1.0};  ///< unit, from tip to shank
    glm::dvec3 hand_position_mm{0.0};    ///< where the device is; leads the burr by what the coupling yields
    glm::dvec3 force_n{0.0};             ///< on the hand
    std::size_t burr = 0;                ///< index into the session's burrs
    bool spindle_on = false;
    double removed_mm3 = 0.0;  ///< since the server began
    bool touches_protected = false;
    std::string fault{};  ///< one line; empty while all is well
    /// The server's wall clock when it took this off the haptic loop, ns since 1970; 0: not said.
    std::int64_t taken_unix_ns = 0;
    ToolDriver driver = ToolDriver::unknown;
    /// Of the burr's tip below where it first met bone, along the spindle axis of that moment; nothing where
    /// the server does not say.
    std::optional<double> depth_mm{};
};

/// What the operator's mouse and keys say, for a server that runs with --device client.
struct OperatorIntent {
    glm::dvec3 hand_target_mm{0.0};      ///< patient LPS
    glm::dvec3 spindle_axis{0, 0, 1.0};  ///< from tip to shank; any length above zero
    bool pedal = false;                  ///< spindle on while true
    std::size_t burr = 0;                ///< index into the session's burrs
};

}  // namespace osteomill
