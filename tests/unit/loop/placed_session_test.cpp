// A session whose tool is placed elsewhere while it holds still, at another speed of the spindle, and the
// same session once more from its ticks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "devices/simulated/hand_and_arm.h"
#include "devices/simulated/prescribed_device.h"
#include "simulation/loop/milling_session.h"
#include "tests/support/block.h"
#include "tests/support/kept_ticks.h"

namespace osteomill::placed_session_test {
namespace {

constexpr std::uint64_t ticks = 2000;
constexpr std::uint64_t paused_at = 900;
constexpr std::uint64_t placed_at = 1000;
const ToolPose elsewhere{{2.1, 0.7, 1.3}, glm::normalize(glm::dvec3(0.3, -0.2, 1.0))};

Scene scene() {
    Scene scene;
    scene.burrs = {{.name = "2 mm", .diameter_mm = 2.0}};
    scene.start_pose = {{-2.0, 0.0, 1.5}, {0.0, 0.0, 1.0}};
    return scene;
}

/// Sets its device and what controls it before each tick. Returns its ticks and the checksum of its bone.
template <typename BeforeTick>
std::pair<std::vector<TickSample>, std::uint64_t> run(HapticDevice& device, const BeforeTick& before_tick) {
    testing::KeptTicks log;
    MillingSession session(scene(), testing::make_block({-4.0, -4.0, -1.0}, {4.0, 4.0, 0.0}, 0.1), device,
                           {.clock = ClockKind::virtual_time, .can_be_controlled = true}, &log);
    session.start();
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        before_tick(tick, session.exchange());
        session.advance(1);
    }
    session.end();
    return {std::move(log.samples), checksum(session.bone())};
}

void place(SessionExchange& exchange, std::uint64_t number, const ToolPose& pose) {
    exchange.placements.back() = {.number = number, .pose = pose};
    exchange.placements.publish();
}

/// A hand that goes down and along, is placed elsewhere, and goes down there. The pedal is let go in between.
std::pair<std::vector<TickSample>, std::uint64_t> recorded() {
    PrescribedDevice device(scene().start_pose, DeviceMapping{}, limits_of(ArmModel{}));
    return run(device, [&](std::uint64_t tick, SessionExchange& exchange) {
        const double s = 0.001 * static_cast<double>(tick);
        ToolPose hand{{-2.0 + 0.61 * s, 0.1 * s, 1.5 - 0.9 * s}, {0.0, 0.0, 1.0}};
        if (tick > placed_at) {
            hand = elsewhere;
            hand.position_mm.z -= 1.6 * std::max(s - 1.5, 0.0);  // until then the force comes back
        }
        device.move_to(hand);
        device.press(tick > 0 && (tick < paused_at || tick > placed_at + 100));
        exchange.gate.stillness.set(tick >= paused_at && tick < placed_at + 50);
        if (tick == 500) exchange.gate.spindle_rpm = 23'457;
        if (tick == placed_at) place(exchange, 1, elsewhere);
    });
}

TEST(PlacedSession, SaysInItsTicksWhereItWasPlacedAndHowFastItTurned) {
    const auto [made, bone] = recorded();
    ASSERT_EQ(made.size(), ticks);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        EXPECT_EQ(made[tick].input.value().is_placed, tick == placed_at) << tick;
        EXPECT_EQ(made[tick].input.value().chosen_rpm, tick < 500 ? 0U : 23'457U) << tick;
    }
    EXPECT_LT(glm::distance(made[placed_at].hand_mm, elsewhere.position_mm), 1e-6);
    EXPECT_GT(made[paused_at].removed_mm3, 0.01);
    EXPECT_GT(made.back().removed_mm3, made[placed_at].removed_mm3 + 0.01);
}

TEST(PlacedSession, IsTheSameToTheBitFromTheTicksAlone) {
    const std::pair session = recorded();  // clang 14 lets no lambda refer to a structured binding
    const auto& made = session.first;
    RecordedDevice device(limits_of(ArmModel{}), DeviceMapping{});
    std::uint64_t placements = 0;
    const auto [again, bone_again] = run(device, [&](std::uint64_t tick, SessionExchange& exchange) {
        const TickSample& said = made[tick];
        device.say(said);
        exchange.gate.stillness.set(said.input->holds_still);
        exchange.gate.spindle_rpm = said.input->chosen_rpm;
        if (said.input->is_placed) place(exchange, ++placements, {said.hand_mm, said.spindle_axis});
    });
    EXPECT_EQ(placements, 1U);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) ASSERT_EQ(again[tick], made[tick]) << tick;
    EXPECT_EQ(bone_again, session.second);
}

}  // namespace
}  // namespace osteomill::placed_session_test
