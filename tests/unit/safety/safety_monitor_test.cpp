// The safety monitor, exhaustively: every state that can be reached, and from each everything that can
// happen.
#include "simulation/safety/safety_monitor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <vector>

namespace osteomill::safety_monitor_test {
namespace {

using State = ForceGuard::State;

/// Long enough for a force to reach any other within a tick, so that the forces that occur are few and the
/// states finite; short against every time constant of the monitor.
constexpr double tick_s = 0.01;
constexpr double limit_n = 3.0;
constexpr double time_to_zero_s = 0.05;  // the promise

/// An event of a tick.
struct Event {
    Fault fault = Fault::none;
    PedalSeen pedal = PedalSeen::up;
    double wanted_n = 0.0;
    bool is_sound = true;
    double elapsed_s = tick_s;
    Clearance clearance = Clearance::clear;

    bool is_fault() const { return fault != Fault::none || !is_sound || !std::isfinite(wanted_n); }
};

std::vector<Event> every_event() {
    std::vector<Event> events;
    for (const PedalSeen pedal : {PedalSeen::up, PedalSeen::lapsed, PedalSeen::waiting, PedalSeen::down}) {
        for (const double wanted_n : {0.0, 1.0, 1e300, -1e300, std::nan(""), HUGE_VAL}) {
            events.push_back({Fault::none, pedal, wanted_n});
            for (const Fault fault : all_faults) {
                events.push_back({fault, pedal, wanted_n});
                // The machine stood still, which is a fault, too: a tick that is longer than any fade.
                events.push_back({fault, pedal, wanted_n, true, 1.0});
            }
        }
        events.push_back({Fault::none, pedal, 1.0, false});
    }
    const std::size_t out_of_bone = events.size();
    for (const Clearance clearance : {Clearance::in_bone, Clearance::unknown}) {
        for (std::size_t i = 0; i < out_of_bone; ++i) {
            events.push_back(events[i]);
            events.back().clearance = clearance;
        }
    }
    return events;
}

/// A monitor with the force that it last let through, and how it came to be there.
struct Reached {
    SafetyMonitor monitor{tick_s, limit_n};
    glm::dvec3 force_n{0.0};
    int quiet_ticks = 1000;  ///< since the last fault, 1000 for more
    int off_ticks = 0;       ///< in `off`, since the last fault or bone in the burr
    int clear_ticks = 1000;  ///< since bone was last in the burr, 1000 for more
    int ticks_of_fault = 0;  ///< since the force was turned off, 1000 for more

    Reached after(const Event& event) const {
        Reached next = *this;
        next.monitor.begin(event.fault, event.pedal, event.clearance);
        next.force_n = next.monitor.pass({event.wanted_n, 0.0, 0.0}, event.is_sound, event.elapsed_s);
        next.quiet_ticks = event.is_fault() ? 0 : std::min(1000, quiet_ticks + 1);
        const bool is_clear = event.clearance == Clearance::clear;
        next.clear_ticks = is_clear ? std::min(1000, clear_ticks + 1) : 0;
        const bool restarts = event.is_fault() || !is_clear || monitor.state() != State::off;
        next.off_ticks = restarts ? 0 : off_ticks + 1;
        next.ticks_of_fault = next.monitor.fault() == Fault::none ? 0 : std::min(1000, ticks_of_fault + 1);
        return next;
    }
    /// All that the future depends on: two monitors that agree in this behave alike. Times differ by the
    /// number of ticks in a state.
    using Key = std::tuple<State, bool, bool, double, int, int>;
    Key key(int ticks_in_state) const {
        return {monitor.state(),
                monitor.is_untried(),
                monitor.is_spindle_locked(),
                force_n.x,
                monitor.state() == State::active ? 0 : ticks_in_state,
                monitor.state() == State::off ? off_ticks : 0};
    }
};

/// Calls `check(from, event, to)` for every transition of every state that can be reached; gives the states.
std::vector<Reached> explore(const std::function<void(const Reached&, const Event&, const Reached&)>& check =
                                 [](auto&&...) {}) {
    const std::vector<Event> events = every_event();
    std::map<Reached::Key, int> seen;
    std::vector<std::pair<Reached, int>> frontier{{Reached{}, 0}};
    std::vector<Reached> states;
    seen[frontier.front().first.key(0)] = 1;
    while (!frontier.empty()) {
        const auto [from, ticks_in_state] = frontier.back();
        frontier.pop_back();
        states.push_back(from);
        for (const Event& event : events) {
            const Reached to = from.after(event);
            check(from, event, to);
            // Within `off` nothing but the ticks since a fault counts.
            const bool is_same =
                to.monitor.state() == from.monitor.state() && to.monitor.state() != State::off;
            const int ticks = is_same ? std::min(ticks_in_state + 1, 100) : 0;
            if (seen[to.key(ticks)]++ == 0) frontier.emplace_back(to, ticks);
        }
    }
    return states;
}

TEST(SafetyMonitor, LeadsFromNoStateByAnyFaultToAForce) {
    std::size_t transitions = 0;
    const std::vector<Reached> states =
        explore([&](const Reached& from, const Event& event, const Reached& to) {
            ++transitions;
            const double before_n = glm::length(from.force_n);
            const double after_n = glm::length(to.force_n);
            ASSERT_TRUE(std::isfinite(after_n));
            ASSERT_LE(after_n, limit_n * (1.0 + 1e-12));
            if (event.is_fault()) {
                ASSERT_LE(after_n, before_n) << "a fault never makes a force, and never more of one";
                ASSERT_TRUE(to.monitor.state() == State::fading_out || to.monitor.state() == State::off);
            }
            if (to.monitor.state() == State::off || to.monitor.is_untried()) {
                ASSERT_EQ(after_n, 0.0);
            }
            if (to.monitor.fault() != Fault::none) {
                ASSERT_LE(after_n, before_n) << "nor does it come back before the fault has gone";
                if (to.ticks_of_fault * tick_s >= time_to_zero_s) {
                    ASSERT_EQ(after_n, 0.0);
                }
            }
            const bool comes_back = from.monitor.fault() != Fault::none && to.monitor.fault() == Fault::none;
            if (comes_back) {
                ASSERT_GT(to.quiet_ticks * tick_s, ForceGuard::settle_s - 1e-9);
                ASSERT_GT(to.clear_ticks * tick_s, ForceGuard::settle_s - 1e-9) << "nor in the bone";
            }
        });
    // Every state of both machines is among them, at every stage of a fade.
    std::map<std::pair<State, bool>, int> visited;
    for (const Reached& reached : states)
        ++visited[{reached.monitor.state(), reached.monitor.is_spindle_locked()}];
    EXPECT_EQ(visited.size(), 8u);
    EXPECT_GT((visited[{State::fading_in, false}]), static_cast<int>(ForceGuard::fade_in_s / tick_s));
    EXPECT_EQ(transitions, states.size() * every_event().size());
    std::printf("%zu states, %zu transitions\n", states.size(), transitions);
}

TEST(SafetyMonitor, TurnsTheSpindleOnlyInAHandThatIsThereAndHasLetGoOfThePedal) {
    explore([](const Reached& from, const Event& event, const Reached& to) {
        const bool locks = event.fault == Fault::device_lost || event.fault == Fault::device_jumped ||
                           event.fault == Fault::energy_to_hand || event.fault == Fault::paused;
        if (to.monitor.spindle_turns()) {
            ASSERT_TRUE(event.pedal == PedalSeen::down && !event.is_fault());
            ASSERT_FALSE(from.monitor.is_spindle_locked());
            ASSERT_FALSE(to.monitor.is_untried());
            ASSERT_TRUE(to.monitor.state() == State::active || to.monitor.state() == State::fading_in);
        }
        const bool is_held = event.pedal == PedalSeen::down || event.pedal == PedalSeen::waiting;
        if (event.pedal == PedalSeen::lapsed || (locks && is_held)) {
            ASSERT_TRUE(to.monitor.is_spindle_locked());
        }
        if (to.monitor.has_just_let_go() && is_held) {
            ASSERT_TRUE(to.monitor.is_spindle_locked()) << "whatever the reason";
        }
        const bool unlocks = from.monitor.is_spindle_locked() && !to.monitor.is_spindle_locked();
        if (unlocks) {
            ASSERT_TRUE(event.pedal == PedalSeen::up && event.fault != Fault::device_lost);
        }
    });
}

TEST(SafetyMonitor, GivesNoForceInsideTheBoneHoweverLongItLasts) {
    for (const Clearance clearance : {Clearance::in_bone, Clearance::unknown})
        for (const Reached& reached : explore()) {
            Reached now = reached;
            if (now.monitor.is_untried()) continue;  // see StartsWithoutAForceInsideTheBone
            const bool was_engaged = now.monitor.fault() == Fault::none;
            for (int i = 0; i < 100; ++i) {
                now = now.after({.pedal = i % 2 == 0 ? PedalSeen::down : PedalSeen::up,
                                 .wanted_n = 1.0,
                                 .clearance = clearance});
                if (was_engaged) continue;
                ASSERT_LE(glm::length(now.force_n), glm::length(reached.force_n));
                ASSERT_FALSE(now.monitor.spindle_turns());
            }
            // Bone in the burr is no fault of a tool that has hold of it: a wall gives way a little.
            ASSERT_EQ(now.monitor.fault() == Fault::none, was_engaged);
            if (!was_engaged && clearance == Clearance::in_bone) {
                ASSERT_EQ(now.monitor.fault(), Fault::in_bone);
            }
        }
}

TEST(SafetyMonitor, StartsWithoutAForceInsideTheBone) {
    const Event in_bone{.pedal = PedalSeen::down, .wanted_n = 1.0, .clearance = Clearance::in_bone};
    Reached now;
    for (int i = 0; i < 100; ++i) {
        now = now.after(in_bone);
        ASSERT_EQ(now.monitor.fault(), Fault::in_bone);
        ASSERT_EQ(now.force_n, glm::dvec3(0.0));
        ASSERT_FALSE(now.monitor.spindle_turns());
    }
    EXPECT_EQ(now.monitor.fault_counts()[static_cast<std::size_t>(Fault::in_bone)], 1U);
    int clear_ticks = 0;
    for (; now.monitor.fault() != Fault::none; ++clear_ticks) now = now.after({.wanted_n = 1.0});
    EXPECT_NEAR(clear_ticks * tick_s, ForceGuard::settle_s, 2.0 * tick_s);
}

TEST(SafetyMonitor, StartsInAirWithTheFirstForceAsSoonAsThatIsKnown) {
    Reached now = Reached{}.after({.wanted_n = 1.0, .clearance = Clearance::unknown});
    for (int i = 0; i < 100; ++i) {
        now = now.after({.pedal = PedalSeen::down, .wanted_n = 1.0, .clearance = Clearance::unknown});
        ASSERT_TRUE(now.monitor.is_untried());
        ASSERT_EQ(now.force_n, glm::dvec3(0.0));
        ASSERT_FALSE(now.monitor.spindle_turns());
        ASSERT_EQ(now.monitor.fault(), Fault::none);
    }
    now = now.after({.pedal = PedalSeen::down, .wanted_n = 1.0});
    EXPECT_EQ(now.force_n.x, 1.0) << "no fading in";
    EXPECT_TRUE(now.monitor.spindle_turns());
}

TEST(SafetyMonitor, ComesBackFromEveryStateOnceAllIsWell) {
    for (const Reached& reached : explore()) {
        Reached now = reached;
        const int ticks =
            static_cast<int>((ForceGuard::fade_out_s + ForceGuard::settle_s + ForceGuard::fade_in_s) /
                             tick_s) +
            5;
        for (int i = 0; i < ticks; ++i) now = now.after({.wanted_n = 1.0});
        ASSERT_EQ(now.monitor.state(), State::active);
        ASSERT_NEAR(now.force_n.x, 1.0, 1e-9);
        ASSERT_FALSE(now.monitor.is_spindle_locked());
    }
}

/// A session with a set of faults for each tick; the pedal is held unless a test lets go.
class WrongSession {
  public:
    /// All faults of the watchdog's own that occur outside the bone.
    static constexpr std::array reasons{Fault::device_lost,  Fault::device_jumped,  Fault::model_stalled,
                                        Fault::not_a_number, Fault::energy_to_hand, Fault::paused,
                                        Fault::overrun};

    WrongSession() {
        run({}, 100, false);
        run({}, 100);
    }
    void run(FaultSet wrong, int ticks, bool is_pedal_down = true) {
        for (int i = 0; i < ticks; ++i) tick(wrong, is_pedal_down);
    }
    SafetyMonitor monitor{0.001, limit_n};

  private:
    void tick(FaultSet wrong, bool is_pedal_down) {
        seen_.missed_periods = wrong.has(Fault::overrun) ? 25 : 0;
        seen_.now_s += 0.001 * static_cast<double>(1 + seen_.missed_periods);
        // A model that is late has been so for long enough by now.
        if (!wrong.has(Fault::model_stalled))
            model_s_ = seen_.now_s;
        else
            seen_.now_s = std::max(seen_.now_s, model_s_ + 0.06);
        if (!wrong.has(Fault::model_stalled)) ++seen_.model_step;
        seen_.model_valid = !wrong.has(Fault::not_a_number);
        seen_.device.connected = !wrong.has(Fault::device_lost);
        if (wrong.has(Fault::device_jumped)) seen_.device.position_mm.x += 500.0;
        seen_.energy_to_hand_mj = wrong.has(Fault::energy_to_hand) ? 20.0 : 0.0;
        seen_.holds_still = wrong.has(Fault::paused);
        seen_.device.pedal = {.is_down = is_pedal_down, .said_s = seen_.now_s, .speaker = 1};
        monitor.observe(seen_);
        monitor.pass({0.0, 0.0, 1.0}, true, 0.001);
    }

    Observation seen_;
    double model_s_ = 0.0;
};

/// A spindle that any fault has stopped starts by a fresh press alone, whatever else is wrong before, with
/// and after it. A pedal that is pressed during the first fault is withdrawn by the faults that withdraw it,
/// and by nothing else.
TEST(SafetyMonitor, LetsNoFaultHideAnotherThatWithdrawsThePedal) {
    int pairs = 0;
    for (const Fault first : WrongSession::reasons)
        for (const Fault second : WrongSession::reasons) {
            FaultSet both(first);
            both.add(second);
            // The second arrives while the first lasts, or with it; and either is the first to leave.
            for (const FaultSet before : {FaultSet(first), FaultSet()})
                for (const FaultSet after : {FaultSet(first), FaultSet(second), FaultSet()}) {
                    for (const bool is_pressed_meanwhile : {false, true}) {
                        if (is_pressed_meanwhile && before.is_empty()) continue;
                        WrongSession session;
                        ASSERT_TRUE(session.monitor.spindle_turns());
                        session.run(before, before.is_empty() ? 0 : 5);
                        if (is_pressed_meanwhile) session.run(before, 5, false);
                        if (is_pressed_meanwhile) session.run(before, 5);
                        session.run(both, 5);
                        ASSERT_TRUE(both.has(session.monitor.fault()));
                        session.run(after, after.is_empty() ? 0 : 5);
                        session.run({}, 1000);
                        const bool withdraws = withdraws_pedal(first) || withdraws_pedal(second);
                        ASSERT_EQ(session.monitor.fault(), Fault::none);
                        ASSERT_EQ(session.monitor.spindle_turns(), is_pressed_meanwhile && !withdraws)
                            << describe(first) << "; " << describe(second);
                        session.run({}, 2, false);
                        session.run({}, 2);
                        ASSERT_TRUE(session.monitor.spindle_turns()) << "pressed anew";
                        ++pairs;
                    }
                }
        }
    EXPECT_EQ(pairs, 7 * 7 * 9);
}

TEST(SafetyMonitor, WithdrawsThePedalAsLongAsTheseFaultsLastAndNoOthers) {
    for (const Fault fault : all_faults) {
        const bool withdraws = fault == Fault::device_lost || fault == Fault::device_jumped ||
                               fault == Fault::energy_to_hand || fault == Fault::paused;
        EXPECT_EQ(withdraws_pedal(fault), withdraws) << describe(fault);
    }
    EXPECT_FALSE(withdraws_pedal(Fault::none));
}

TEST(SafetyMonitor, CountsEachTimeTheForceWentOffOnceUnderTheFaultThatWasTold) {
    WrongSession session;
    FaultSet both(Fault::paused);
    both.add(Fault::model_stalled);
    session.run(both, 10);
    session.run(Fault::paused, 10);
    session.run({}, 1000);
    std::uint64_t sum = 0;
    for (const std::uint64_t count : session.monitor.fault_counts()) sum += count;
    EXPECT_EQ(sum, 1U);
    EXPECT_EQ(session.monitor.fault_counts()[static_cast<std::size_t>(Fault::model_stalled)], 1U);
}

/// The other half of the chain: whatever is wrong, alone or together with anything else, is found.
TEST(SafetyMonitor, FindsEveryCombinationOfWhatCanBeWrong) {
    for (unsigned wrong = 0; wrong < 64; ++wrong) {
        SafetyMonitor monitor(0.001, limit_n);
        Observation seen;
        const auto tick = [&](unsigned now_wrong) {
            seen.now_s += 0.001;
            if (!(now_wrong & 1)) ++seen.model_step;
            seen.model_valid = !(now_wrong & 2);
            seen.device.connected = !(now_wrong & 4);
            seen.device.position_mm.x =
                now_wrong & 8 ? (seen.device.position_mm.x > 0.0 ? -50.0 : 50.0) : 0.0;
            seen.device.position_mm.y = now_wrong & 16 ? NAN : 0.0;
            seen.missed_periods = now_wrong & 32 ? 3 : 0;
            monitor.observe(seen);
            return glm::length(monitor.pass({0.0, 0.0, 2.0}, true, 0.001));
        };
        for (int i = 0; i < 100; ++i) tick(0);
        double force_n = 0.0;
        for (int i = 0; i < 200; ++i) force_n = tick(wrong);
        EXPECT_EQ(force_n == 0.0, wrong != 0) << "combination " << wrong;
    }
}

}  // namespace
}  // namespace osteomill::safety_monitor_test
