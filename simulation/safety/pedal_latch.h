// Latch of the spindle, fed with the device's reports of its pedal: the one place that trusts a pedal, for
// every device.
//
//             the statement has lapsed, or permission is withdrawn
//   free ---------------------------------------------------------> locked
//     ^                                                                |
//     +---------------- the pedal is seen up, and fresh ---------------+
//
// A statement lapses when it is older than longest_age_s, when the loop itself stood still for so long (the
// clock of a stopped program stands, too, and the old statement would seem fresh), and when another party
// speaks. Silence is not a release: a person who held the pedal through it may not mean the bone at
// which the burr is afterwards. The latch starts locked.
#pragma once

#include <cstdint>

#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"

namespace osteomill {

/// A statement, as the loop reads it.
enum class PedalSeen : std::uint8_t {
    lapsed,
    up,
    waiting,  ///< down, and does not count yet (PedalStatement::acts_after_s)
    down,
};

/// Looks at the statements, tick by tick. Real-time safe, as all here.
class PedalDate {
  public:
    static constexpr double longest_age_s = Permission::by_message_s;

    /// Once a tick, at session time `now_s`. A time that is no number is a lapse.
    PedalSeen look(const PedalStatement& said, double now_s) noexcept {
        const bool goes_on = now_s - looked_s_ <= longest_age_s && said.speaker == speaker_;
        looked_s_ = now_s;
        speaker_ = said.speaker;
        const bool is_fresh = now_s - said.said_s <= longest_age_s;
        if (is_fresh && !said.is_down) return seen_ = PedalSeen::up;
        if (!is_fresh || !goes_on) return seen_ = PedalSeen::lapsed;
        if (seen_ == PedalSeen::up || seen_ == PedalSeen::lapsed) pressed_s_ = now_s;
        const bool is_due = seen_ == PedalSeen::down || now_s - pressed_s_ >= said.acts_after_s;
        return seen_ = is_due ? PedalSeen::down : PedalSeen::waiting;
    }

    PedalSeen seen() const { return seen_; }

  private:
    PedalSeen seen_ = PedalSeen::lapsed;
    std::uint64_t speaker_ = 0;
    double looked_s_ = 0.0;
    double pressed_s_ = 0.0;
};

class PedalLatch {
  public:
    /// Once a tick. `is_withdrawn`: something else ends the permission.
    void tick(PedalSeen seen, bool is_withdrawn) noexcept {
        seen_ = seen;
        if (is_withdrawn || seen == PedalSeen::lapsed) is_locked_ = true;
        if (seen == PedalSeen::up) is_locked_ = false;
    }
    /// Later in the tick: a pedal that is held has no effect before it has been up.
    void withdraw() noexcept {
        if (seen_ != PedalSeen::up) is_locked_ = true;
    }

    /// The spindle may turn.
    bool is_pressed() const { return seen_ == PedalSeen::down && !is_locked_; }
    bool is_locked() const { return is_locked_; }
    /// The pedal is held and may turn the spindle, now or once it is no longer PedalSeen::waiting.
    bool is_good() const { return !is_locked_ && (seen_ == PedalSeen::down || seen_ == PedalSeen::waiting); }
    /// The pedal is held, and has no effect before it has been up.
    bool awaits_release() const {
        return is_locked_ && (seen_ == PedalSeen::down || seen_ == PedalSeen::waiting);
    }

  private:
    PedalSeen seen_ = PedalSeen::lapsed;
    bool is_locked_ = true;
};

}  // namespace osteomill
