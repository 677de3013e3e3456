// What the streaming loop hands to the device, with --device client. Plain data, no pointers.
#pragma once

#include <cstddef>

#include "common/scene/scene.h"

namespace osteomill {

/// What the operator's mouse and keys say. The reader gives it no longer than Permission::by_message_s.
struct OperatorInput {
    ToolPose hand_target;  ///< patient space
    bool pedal = false;
    std::size_t burr = 0;
    bool present = false;  ///< false while no operator is connected: it counts as nothing
};

}  // namespace osteomill
