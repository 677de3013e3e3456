// Faults put into the loop while a hand presses on bone, with every coupling: the force is gone in time,
// stays away while the burr is in the bone, and comes back without a jump when the hand has lifted it out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <tuple>

#include "simulation/coupling/couplings.h"
#include "simulation/loop/haptic_loop.h"
#include "tests/unit/loop/scripted_parts.h"

namespace osteomill {
namespace {

using testing::tick_s;
constexpr int most_ticks_to_zero = 50;
/// The bar for any coupling: no jump between ticks that the hand did not ask for.
constexpr double most_jump_n = 0.3;

/// A hand that presses 0.8 mm into a plane of bone, spindle off, and a milling loop that shows the plane.
class PressedHand {
  public:
    explicit PressedHand(const std::string& method)
        : coupling_(make_coupling(coupling_named(method),
                                  {.device = in_patient_space(device.limits(), ArmScale())})) {
        device.script = [](double t_s) {
            return DeviceState{.position_mm = {0.0, 0.0, std::max(-0.8, 0.1 - 4.0 * t_s)}};
        };
        loop_ = std::make_unique<HapticLoop>(
            HapticLoopParts{device, *coupling_, *results_, commands_, tool_, status_}, HapticLoopOptions{});
    }

    testing::ScriptedDevice device;
    bool model_runs = true;
    bool model_is_valid = true;
    double model_force_n = 0.0;

    double now_s() const { return tick_s * static_cast<double>(number_); }

    /// The force written in one more tick, and before it `missed` deadlines that nobody served.
    glm::dvec3 tick(std::uint64_t missed = 0) {
        if (model_runs) show_plane();
        number_ += missed;
        loop_->tick(tick_s * static_cast<double>(number_++), missed);
        commands_.refresh();
        return device.written_n.back();
    }

  private:
    void show_plane() {
        MillingResult& result = results_->back();
        result = MillingResult{};
        result.step = ++step_;
        result.time_s = tick_s * static_cast<double>(number_);
        result.pose = commands_.front().pose;
        result.valid = model_is_valid;
        result.force_n = glm::dvec3(model_force_n);
        result.engagement.burr_position_mm = result.pose.position_mm;
        result.engagement.count = 1;
        result.engagement.patches[0] = {
            .normal = {0.0, 0.0, -1.0}, .gap_mm = result.pose.position_mm.z, .area_mm2 = 10.0};
        results_->publish();
    }

    std::unique_ptr<Coupling> coupling_;
    std::unique_ptr<TripleBuffer<MillingResult>> results_ = std::make_unique<TripleBuffer<MillingResult>>();
    TripleBuffer<BurrCommand> commands_;
    TripleBuffer<ToolState> tool_;
    TripleBuffer<ToolState> status_;
    std::unique_ptr<HapticLoop> loop_;
    std::uint64_t number_ = 0;
    std::uint64_t step_ = 0;
};

struct Injection {
    std::string name;
    std::function<void(PressedHand&)> begin;
    std::function<void(PressedHand&)> end;
    int ticks_to_see = 0;      ///< how long it takes to be a fault
    std::uint64_t missed = 0;  ///< deadlines, before each tick
};

void rest_in_bone(PressedHand& hand) {
    hand.device.script = [](double) { return DeviceState{.position_mm = {0.0, 0.0, -0.8}}; };
}

std::vector<Injection> injections() {
    return {{"NanFromTheModel", [](PressedHand& h) { h.model_is_valid = false, h.model_force_n = NAN; },
             [](PressedHand& h) { h.model_is_valid = true, h.model_force_n = 0.0; }},
            {"StalledMillingLoop", [](PressedHand& h) { h.model_runs = false; },
             [](PressedHand& h) { h.model_runs = true; },
             static_cast<int>(Watchdog::longest_model_age_s / tick_s) + 1},
            {"VanishedDevice",
             [](PressedHand& h) {
                 h.device.script = [](double) {
                     return DeviceState{.position_mm = {NAN, 0, 0}, .connected = false};
                 };
             },
             rest_in_bone},
            {"OverrunStreak", [](PressedHand&) {}, [](PressedHand&) {},
             static_cast<int>(Watchdog::longest_overrun_s / tick_s) / 2 + 1, 2},
            {"TeleportingDevice",
             [](PressedHand& h) {
                 h.device.script = [](double now_s) {
                     const double side = std::lround(now_s / tick_s) % 2 == 0 ? 40.0 : -40.0;
                     return DeviceState{.position_mm = {side, 0.0, -0.8}};
                 };
             },
             rest_in_bone}};
}

/// Lifts by 1.2 mm, waits for the force and presses as before.
void press_again(PressedHand& hand, double now_s) {
    constexpr double mm_per_s = 4.0;
    hand.device.script = [now_s](double t_s) {
        const double lifted_mm = std::min({mm_per_s * (t_s - now_s), 1.2, mm_per_s * (1.3 - (t_s - now_s))});
        return DeviceState{.position_mm = {0.0, 0.0, -0.8 + std::max(0.0, lifted_mm)}};
    };
}

class FaultInjection : public ::testing::TestWithParam<std::tuple<std::string, std::size_t>> {};

TEST_P(FaultInjection, TurnsTheForceOffInTimeAndOnWithoutAJumpOnceLiftedOut) {
    const Injection injection = injections()[std::get<1>(GetParam())];
    PressedHand hand(std::get<0>(GetParam()));
    glm::dvec3 before_n(0.0);
    for (int i = 0; i < 1500; ++i) before_n = hand.tick();
    ASSERT_GT(glm::length(before_n), 0.5) << "the wall is felt";

    injection.begin(hand);
    constexpr int faulty_ticks = 300;
    for (int i = 0; i < faulty_ticks; ++i) {
        const glm::dvec3 now_n = hand.tick(injection.missed);
        ASSERT_TRUE(std::isfinite(glm::length(now_n)));
        const int seen_for = i - injection.ticks_to_see;
        ASSERT_TRUE(seen_for < 0 || glm::length(now_n) <= glm::length(before_n)) << "tick " << i;
        ASSERT_TRUE(seen_for < most_ticks_to_zero || now_n == glm::dvec3(0.0)) << "tick " << i;
        before_n = now_n;
    }

    injection.end(hand);
    for (int i = 0; i < 600; ++i) ASSERT_EQ(hand.tick(), glm::dvec3(0.0)) << "tick " << i << " in the bone";

    press_again(hand, hand.now_s());
    before_n = glm::dvec3(0.0);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 now_n = hand.tick();
        ASSERT_GE(now_n.z, -0.02) << "tick " << i << " after the fault: pulled deeper";
        ASSERT_LE(glm::distance(now_n, before_n), most_jump_n) << "tick " << i << " after the fault";
        before_n = now_n;
    }
    EXPECT_GT(glm::length(before_n), 0.5) << "the wall is felt again";
}

std::string without_hyphens(std::string name) {
    std::erase(name, '-');
    return name;
}

std::vector<std::string> names_of_couplings() {
    std::vector<std::string> names;
    for (const CouplingEntry& coupling : couplings()) names.push_back(coupling.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(EveryCoupling, FaultInjection,
                         ::testing::Combine(::testing::ValuesIn(names_of_couplings()),
                                            ::testing::Range(std::size_t{0}, std::size_t{5})),
                         [](const auto& tested) {
                             return without_hyphens(std::get<0>(tested.param)) + "_" +
                                    injections()[std::get<1>(tested.param)].name;
                         });

}  // namespace
}  // namespace osteomill
