// The one place that decides whether the hand may feel a force and the burr may turn. It looks for faults
// (watchdog.h), limits and fades the force (force_guard.h), keeps the force off while the tool is inside bone
// after a fault or at the start, and keeps the spindle off after interruptions, when the pressed pedal was
// meant for other bone. Nothing reaches the device except through it.
//
// Two state machines, stepped together once a tick. The force:
//
//             fault                faded out              no fault for settle_s
//   active ----------> fading out -----------> off --------------------------> fading in
//     ^                    ^                    | ^ (stays off while a fault       |  |
//     |                    |                    +-+  lasts, or bone in the burr)   |  |
//     |                    +----------------------- fault -------------------------+  |
//     +------------------------------- faded in --------------------------------------+
//
// It starts in `active`, but untried: until a milling result shows whether there is bone in the burr
// (clearance.h), no force is felt and no bone touched. A burr that is clear becomes tried at once; a burr in
// bone goes off, as if it had come back there. So a session that starts in air feels the first force, and a
// session that starts in bone feels none.
//
//   state        the hand feels                              the tool
//   untried      nothing                                     is out of the bone
//   active       the wanted force, within limit and rate     touches bone
//   fading out   the last force, shrinking to nothing        is out of the bone: no spindle, no wall
//   off          nothing                                     is out of the bone
//   fading in    the wanted force, a gain from 0 to 1        touches bone
//
// Back inside the bone. Without a force, nothing keeps the hand from sinking into the bone. If the tool took
// hold again there, every wall would be wrong: bone on all sides holds a proxy that starts inside, and pulls
// the hand back in when it leaves; the nearest way out may be the wrong side of a thin wall, and a hand
// thrown out over millimetres is as bad as one pulled in. So `off` lasts until the burr, at the hand's
// position, has been known to be clear of bone (clearance.h) for settle_s; until then the fault is
// Fault::in_bone. The hand lifts the burr out and feels nothing, nothing is cut, and the force fades in when
// every wall is in front of the burr. While the hand moves too fast to know, `off` lasts, too, with the
// earlier fault.
//
// The spindle turns while the pedal is down, its latch (pedal_latch.h) is free and the tool touches bone.
// Beside the reasons in pedal_latch.h, it is locked if the force goes off, for whatever reason: a spindle
// that stopped starts again by a fresh press alone. And it is locked for as long as a fault lasts that
// withdraws_pedal() (fault.h), whatever else is wrong in the same tick.
//
// In no state does a fault lead to a force: from the tick of a fault until settle_s have passed without one
// and clear of bone, the force only shrinks, and within fade_out_s it is zero. safety_monitor_test.cpp visits
// every reachable state, with every fault in each, in bone and out.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "simulation/safety/fault.h"
#include "simulation/safety/force_guard.h"
#include "simulation/safety/pedal_latch.h"
#include "simulation/safety/watchdog.h"

namespace osteomill {

class SafetyMonitor {
  public:
    static constexpr std::size_t fault_kinds = all_faults.size() + 1;

    SafetyMonitor(double tick_s, double max_force_n) : watchdog_(tick_s), guard_(max_force_n) {}

    /// Begins a tick: looks for faults. Real-time safe, like all here.
    void observe(const Observation& seen) noexcept {
        begin(watchdog_.check(seen), pedal_date_.look(seen.device.pedal, seen.now_s), seen.clearance);
    }
    /// The pedal as observe() saw it.
    PedalSeen pedal_seen() const { return pedal_date_.seen(); }

    /// Begins a tick with given findings, for callers with checks of their own. `pedal` counts only if the
    /// device is there, `clearance` only while the force is off or untried.
    void begin(FaultSet found, PedalSeen pedal, Clearance clearance) noexcept;

    /// Whether the device's reading can be used in this tick.
    bool has_hand() const { return !found_.has(Fault::device_lost); }
    /// Whether the force is to be computed in this tick: no fault, and the hand may feel it.
    bool may_touch() const { return found_.is_empty() && guard_.is_engaged(); }

    /// Ends the tick: the force that may be written, for the requested one (not read unless may_touch()).
    /// `is_sound`: everything else computed with it is finite; otherwise it counts as a fault, like a force
    /// that is not finite.
    glm::dvec3 pass(const glm::dvec3& wanted_n, bool is_sound, double elapsed_s) noexcept;

    /// After pass(): the tool touched bone before this tick and goes on doing so.
    bool holds_tool() const { return was_engaged_ && guard_.is_engaged() && !is_untried_; }
    /// After pass(): the force was turned off in this tick.
    bool has_just_let_go() const { return was_engaged_ && !guard_.is_engaged(); }
    /// After pass(): the spindle turns in this tick.
    bool spindle_turns() const { return holds_tool() && wants_spindle(); }
    /// The pedal is held and has permission, whatever else keeps the spindle off: it turns as soon as that
    /// ends.
    bool is_pedal_good() const { return pedal_.is_good(); }
    /// State of the spindle for the coupling, before pass().
    bool wants_spindle() const { return pedal_.is_pressed() && has_hand() && !is_untried_; }

    ForceGuard::State state() const { return guard_.state(); }
    bool is_spindle_locked() const { return pedal_.is_locked(); }
    /// The pedal is held, but turns nothing before it has been up.
    bool awaits_release() const { return pedal_.awaits_release(); }
    /// The fault that last locked the spindle; none once the pedal was up, and if something else did: the
    /// start, a lapse, another speaker (pedal_latch.h).
    Fault spindle_locked_by() const { return spindle_locked_by_; }
    /// The fault that last took the force off, though fault() may be a later one: Fault::in_bone if the hand
    /// sank into the bone meanwhile. None if none did since the start.
    Fault force_taken_by() const { return force_taken_by_; }
    /// Nothing is known yet of bone in the burr, and there was no fault.
    bool is_untried() const { return is_untried_; }
    /// Why the force is off, the one reason shown to people; none while it is on.
    Fault fault() const { return guard_.fault(); }
    /// How often each Fault was the reason shown to people when the force went off.
    const std::array<std::uint64_t, fault_kinds>& fault_counts() const { return fault_counts_; }

  private:
    Watchdog watchdog_;
    ForceGuard guard_;
    FaultSet found_;                 // in this tick
    Fault keeps_off_ = Fault::none;  // why the force is off: this tick's first fault, else an earlier one or
                                     // bone in the burr
    PedalDate pedal_date_;
    PedalLatch pedal_;
    Fault spindle_locked_by_ = Fault::none;
    Fault force_taken_by_ = Fault::none;
    bool is_untried_ = true;
    bool was_engaged_ = true;
    std::array<std::uint64_t, fault_kinds> fault_counts_{};
};

}  // namespace osteomill
