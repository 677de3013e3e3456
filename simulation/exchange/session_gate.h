// Instructions of a session's keeper to the haptic loop: the spindle's speed, and whether to hold still.
// While the session holds still there is neither force nor spindle, and only undo changes the bone.
#pragma once

#include <atomic>
#include <cstdint>

#include "common/scene/scene.h"

namespace osteomill {

struct SessionGate {
    std::atomic<bool> holds_still{false};
    /// Number of restored changes that the milling loop has applied since the start. Written after the change
    /// itself, so that a reader of this number finds all of them in the queue of changes.
    std::atomic<std::uint64_t> restored_changes{0};
    /// Number of the placement that the haptic loop has made last.
    std::atomic<std::uint64_t> placed{0};
    /// Speed of the spindle that was chosen; 0: each burr's own.
    std::atomic<double> spindle_rev_per_s{0.0};
};

/// Moves the tool to another place while the hand stays: the device's position on the patient changes. Done
/// while the session holds still.
struct Placement {
    std::uint64_t number = 0;  ///< counted from 1; 0: none
    ToolPose pose;             ///< patient LPS; the axis is a unit vector
};

}  // namespace osteomill
