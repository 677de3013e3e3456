// Whether the session is to hold still, as whoever looks after it tells the haptic loop: while it does, there
// is neither force nor spindle, and nothing but undo changes the bone.
#pragma once

#include <atomic>
#include <cstdint>

namespace osteomill {

struct SessionGate {
    std::atomic<bool> holds_still{false};
    /// Changes from the queue of restored bone that the milling loop has made, since the start. Written
    /// behind the change itself, so who reads it first finds all of them in the queue of changes.
    std::atomic<std::uint64_t> restored_changes{0};
};

}  // namespace osteomill
