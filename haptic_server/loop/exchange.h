// The values that the loops hand to one another. Plain data, no pointers.
#pragma once

#include <cstddef>

#include "common/scene/scene.h"
#include "haptic_server/safety/fault.h"

namespace osteomill {

/// Haptic loop to streaming loop: what a client is shown.
struct ToolSnapshot {
    double time_s = 0.0;
    ToolPose burr_pose;  ///< of the burr in the bone
    ToolPose hand_pose;  ///< of the device, patient space
    std::size_t burr = 0;
    bool spindle_on = false;
    glm::dvec3 force_n{0.0};   ///< on the hand as written to the device, patient axes
    double removed_mm3 = 0.0;  ///< since the start
    bool touches_protected = false;
    Fault fault = Fault::none;  ///< why the force is off
    /// Of the burr's tip below where it first met bone, along the spindle axis of that moment; 0 before.
    double depth_mm = 0.0;
};

}  // namespace osteomill
