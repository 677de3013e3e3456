// Requests and answers between ControlRunner (haptic_server/streaming/control_runner.h), which asks, and
// the two loops, which answer: the spindle's speed, the fixtures that are on, whether to hold still; the
// changes restored and the placement made so far. While the session holds still there is neither force nor
// spindle, and only undo changes the bone.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "common/scene/fixture.h"
#include "common/scene/scene.h"

namespace osteomill {

/// A request that lasts, and that its reader cannot miss, however short it was and however late the reader
/// is.
class StillnessRequest {
  public:
    /// The one writer's.
    void set(bool is_wanted) noexcept {
        const std::uint64_t turns = turns_.load(std::memory_order_relaxed);
        if (is_wanted != is_on(turns)) turns_.store(turns + 1, std::memory_order_release);
    }
    /// Any thread.
    bool is_wanted() const noexcept { return is_on(turns_.load(std::memory_order_acquire)); }
    /// The one reader's: it is wanted, or was since the last call. Real-time safe.
    bool was_wanted() noexcept {
        const std::uint64_t turns = turns_.load(std::memory_order_acquire);
        const std::uint64_t before = std::exchange(seen_, turns);
        return is_on(turns) || turns - before > 1;
    }

  private:
    static bool is_on(std::uint64_t turns) noexcept { return turns % 2 == 1; }

    std::atomic<std::uint64_t> turns_{0};  // on and off
    std::uint64_t seen_ = 0;               // the reader's
};

struct SessionGate {
    StillnessRequest stillness;
    /// Number of restored changes that the milling loop has applied since the start. Written after the change
    /// itself, so that a reader of this number finds all of them in the queue of changes.
    std::atomic<std::uint64_t> restored_changes{0};
    /// Number of the placement that the haptic loop has made last.
    std::atomic<std::uint64_t> placed{0};
    /// Speed of the spindle that was chosen, in whole revolutions per minute as recordings keep it; 0: each
    /// burr's own.
    std::atomic<std::uint32_t> spindle_rpm{0};
    /// Fixtures of the scene that are to be on. Taken over while the hand feels no force.
    std::atomic<FixtureSet> fixtures_on{0};
};

/// Moves the tool to another place while the hand stays: the device's position on the patient changes. Done
/// while the session holds still.
struct Placement {
    std::uint64_t number = 0;  ///< counted from 1; 0: none
    ToolPose pose;             ///< patient LPS; the axis is a unit vector
};

}  // namespace osteomill
