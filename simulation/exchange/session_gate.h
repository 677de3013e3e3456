// Instructions of a session's keeper to the haptic loop: how fast the spindle turns, and whether to hold
// still. While it does, there is neither force nor spindle, and nothing but undo changes the bone.
#pragma once

#include <atomic>
#include <cstdint>

#include "common/scene/scene.h"

namespace osteomill {

struct SessionGate {
    std::atomic<bool> holds_still{false};
    /// Changes from the queue of restored bone that the milling loop has made, since the start. Written
    /// behind the change itself, so who reads it first finds all of them in the queue of changes.
    std::atomic<std::uint64_t> restored_changes{0};
    /// Number of the placement that the haptic loop has made last.
    std::atomic<std::uint64_t> placed{0};
    /// Speed of the spindle that was chosen; 0: each burr's own.
    std::atomic<double> spindle_rev_per_s{0.0};
};

/// The tool shall be elsewhere, though the hand stays where it is: what changes is how the device sits on the
/// patient. Done while the session holds still.
struct Placement {
    std::uint64_t number = 0;  ///< counted from 1; 0: none
    ToolPose pose;             ///< patient LPS; the axis is a unit vector
};

}  // namespace osteomill
