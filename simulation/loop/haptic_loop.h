// One tick of the haptic loop: read the device, couple, guard, write the force, and publish the state. The
// pace is periodic_loop.h's, the physics the coupling's.
//
//   device --pose--+---> safety monitor --may touch?--+
//                  |            ^    |                v
//                  |          force  +--force--> device
//                  |            |
//                  +--pose--> coupling --burr pose--> milling loop
//
// During a fault the tool is out of the bone: no spindle, no force. The milling loop only samples the bone at
// the hand's position, and the coupling restarts from the hand when the force returns, which is not before
// the burr is clear of bone there. safety_monitor.h defines the faults and their consequences.
#pragma once

#include <array>
#include <cstdint>

#include "common/scene/scene.h"
#include "common/session/tick_sample.h"
#include "common/session/tool_state.h"
#include "simulation/coupling/coupling.h"
#include "simulation/coupling/handpiece_vibration.h"
#include "simulation/device/fade_out.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/copiable_atomic.h"
#include "simulation/exchange/milling_step.h"
#include "simulation/exchange/sample_log.h"
#include "simulation/exchange/session_gate.h"
#include "simulation/exchange/triple_buffer.h"
#include "simulation/loop/burr_change.h"
#include "simulation/loop/spindle_speed.h"
#include "simulation/safety/energy_meter.h"
#include "simulation/safety/safety_monitor.h"

namespace osteomill {

/// The parts that the haptic loop works with; all of them outlive the loop.
struct HapticLoopParts {
    HapticDevice& device;
    Coupling& coupling;
    TripleBuffer<MillingResult>& results;           ///< read
    TripleBuffer<BurrCommand>& commands;            ///< written
    TripleBuffer<ToolState>& tool;                  ///< written, for the streaming loop
    TripleBuffer<ToolState>& status;                ///< written, for a display of progress
    SampleLog<TickSample>* log = nullptr;           ///< written; null: no log
    HandpieceVibration* vibration = nullptr;        ///< added to the coupling's force; null: none
    SessionGate* gate = nullptr;                    ///< read and written; null: the session never holds still
    TripleBuffer<Placement>* placements = nullptr;  ///< read, with `gate`
};

struct HapticLoopOptions {
    double tick_s = 0.001;
    DeviceMapping mapping{};
    std::size_t burr_count = 1;  ///< size of the scene's set
    std::size_t start_burr = 0;
    std::vector<double> spindle_rev_per_s{};  ///< each burr's; empty: no other speed can be chosen
    bool has_shank = false;                   ///< any burr of the set: its torque is reported
    double removed_before_mm3 = 0.0;  ///< by the sessions before: the reported volume continues from there
    bool has_fixtures = false;        ///< whether the coupling holds any of the scene's fixtures
    FixtureSet fixtures_on = 0;       ///< of them, at the start
    /// The hand's pose before the first tick.
    ToolPose start_pose{};
};

class HapticLoop {
  public:
    static constexpr std::size_t fault_kinds = SafetyMonitor::fault_kinds;
    /// Touching protected tissue is reported for this long, so that no streamed frame misses it.
    static constexpr double protected_shown_s = 0.2;

    HapticLoop(const HapticLoopParts& parts, const HapticLoopOptions& options);
    /// Goes on where `other` is, with other parts. Between ticks.
    HapticLoop(const HapticLoop& other, const HapticLoopParts& parts);
    HapticLoop& operator=(const HapticLoop&) = delete;

    /// The tick of session time `now_s`, after `missed_periods` missed deadlines. Real-time safe, as
    /// settle().
    void tick(double now_s, std::uint64_t missed_periods) noexcept;
    /// Ends the last tick's millisecond and completes its row: so much was removed since the start, and so
    /// many bricks were restored. Otherwise the next tick does so, with the numbers that it knows; for
    /// callers that keep the order of the loops, and at the end.
    void settle(double total_removed_mm3, std::uint64_t restored_changes) noexcept;

    /// Ends the session: from the next tick on the force fades, whatever is requested, and the spindle stops.
    /// Any thread.
    void let_go() noexcept { lets_go_.store(true, std::memory_order_relaxed); }
    /// Whether, after let_go(), the force has faded to zero. Any thread.
    bool has_let_go() const noexcept { return has_let_go_.load(std::memory_order_relaxed); }

    double peak_force_n() const { return peak_force_n_; }
    /// Net energy that the force gave the hand, the most that it was.
    double most_energy_to_hand_mj() const { return energy_.most_mj(); }
    /// How often each Fault turned the force off.
    const std::array<std::uint64_t, fault_kinds>& fault_counts() const { return safety_.fault_counts(); }

  private:
    HapticLoop(const HapticLoop&) = default;
    HandState hand_state(double now_s, double elapsed_s, const DeviceState& device) noexcept;
    /// Whether the tool has just been placed elsewhere.
    bool place(const DeviceState& device) noexcept;
    /// Whether the session holds still in this tick, or has since the last one.
    bool holds_still(const MillingResult& latest) noexcept;
    void take_fixtures() noexcept;
    void publish(const BurrCommand& command) noexcept;
    void show() noexcept;
    double speed_share(double chosen_rpm, double elapsed_s) noexcept;
    const char* notice() const noexcept;
    double depth_mm(bool in_contact) noexcept;
    TickInput input_of(const DeviceState& device, bool lets_go) const noexcept;
    std::uint64_t note_steps(const MillingResult& latest) noexcept;
    void log() noexcept;

    HapticLoopParts parts_;
    HapticLoopOptions options_;
    SafetyMonitor safety_;
    bool gives_force_;
    EnergyMeter energy_;
    glm::dvec3 felt_n_{0.0};  // patient axes; last written and felt
    FadeOut at_the_end_;
    CopiableAtomic<bool> lets_go_{false};
    CopiableAtomic<bool> has_let_go_{false};

    ToolPose hand_pose_;  // patient LPS; the last that was read
    ToolPose burr_pose_;
    BurrChanger burr_;
    SpindleSpeed speed_;
    bool spindle_turned_ = false;         // in the last tick
    std::uint64_t restored_changes_ = 0;  // the last result's
    bool was_stillness_asked_ = false;    // since the last tick
    FixtureSet fixtures_on_;
    double protected_until_s_ = 0.0;

    bool has_met_bone_ = false;
    ToolPose first_contact_;
    double removed_before_mm3_ = 0.0;  // when the tool was placed last

    double peak_force_n_ = 0.0;

    // The last tick, until it is settled.
    bool is_settled_ = true;
    ToolState tool_;
    Fault fault_ = Fault::none;
    TickInput input_{};
    std::uint64_t steps_ = 0;      // that it was the first to see, as a number
    std::uint64_t seen_step_ = 0;  // the last result's
    std::uint64_t settled_restored_changes_ = 0;
    std::uint64_t ticks_ = 0;
};

}  // namespace osteomill
