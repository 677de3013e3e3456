#include "haptic_server/measuring/measuring_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace osteomill {
namespace {

struct Guarded {
    MeasuringGuard guard{3.3};
    double now_s = 0.0;
    DeviceState arm{};

    glm::dvec3 tick(const glm::dvec3& wanted_n, double elapsed_s = 0.001) {
        now_s += elapsed_s;
        arm.pedal.said_s = now_s;
        guard.look(arm, now_s);
        return guard.pass(wanted_n);
    }
    /// The pedal goes down, and a force is felt.
    void begin() {
        EXPECT_EQ(tick({1.0, 0.0, 0.0}), glm::dvec3(0.0)) << "the pedal is up";
        arm.pedal.is_down = true;
        tick({0.5, 0.0, 0.0});
        EXPECT_EQ(tick({0.5, 0.0, 0.0}), glm::dvec3(0.5, 0.0, 0.0));
    }
    void expect_shut(MeasuringEnd why) {
        EXPECT_EQ(guard.end(), why);
        arm = {.pedal = {.is_down = true}};
        for (int i = 0; i < 50; ++i) EXPECT_EQ(tick({0.5, 0.0, 0.0}), glm::dvec3(0.0)) << "for good";
        EXPECT_EQ(guard.end(), why);
    }
};

TEST(MeasuringGuard, LetsNothingThroughBeforeThePedalHasBeenUpAndDown) {
    Guarded held;
    held.arm.pedal.is_down = true;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(held.tick({1.0, 0.0, 0.0}), glm::dvec3(0.0));
    EXPECT_FALSE(held.guard.is_open());
    held.arm.pedal.is_down = false;
    held.begin();
}

TEST(MeasuringGuard, BoundsTheForceAndItsChange) {
    Guarded held;
    held.begin();
    glm::dvec3 last_n(0.5, 0.0, 0.0);
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 force_n = held.tick(i < 10 ? glm::dvec3(9.0, 9.0, 0.0) : glm::dvec3(-9.0, 0.0, 0.0));
        EXPECT_LE(glm::distance(force_n, last_n), 1.0 + 1e-9);
        EXPECT_LE(glm::length(force_n), MeasuringGuard::most_force_n + 1e-9);
        last_n = force_n;
    }
    EXPECT_NEAR(MeasuringGuard(1.0).force_bound_n(), 0.8, 1e-12);
}

TEST(MeasuringGuard, EndsAtOnceWithZeroForce) {
    const auto after = [](auto&& change, MeasuringEnd why) {
        Guarded held;
        held.begin();
        change(held);
        EXPECT_EQ(held.tick({0.5, 0.0, 0.0}), glm::dvec3(0.0));
        held.expect_shut(why);
    };
    after([](Guarded& held) { held.arm.pedal.is_down = false; }, MeasuringEnd::pedal_up);
    after([](Guarded& held) { held.arm.connected = false; }, MeasuringEnd::arm_lost);
    after([](Guarded& held) { held.arm.position_mm.y = std::numeric_limits<double>::quiet_NaN(); },
          MeasuringEnd::not_finite);
    after([](Guarded& held) { held.arm.position_mm.z = 4.1; }, MeasuringEnd::moved_away);
    after([](Guarded& held) { held.now_s += 0.03; }, MeasuringEnd::late);
    Guarded held;
    held.begin();
    EXPECT_EQ(held.tick({std::nan(""), 0.0, 0.0}), glm::dvec3(0.0));
    held.expect_shut(MeasuringEnd::not_finite);
}

TEST(MeasuringGuard, EndsWhenTheHandGetsTooMuchEnergy) {
    Guarded held;
    held.begin();
    // 2 N along 0.1 mm a tick, to and fro over 3 mm: 0.2 mJ a tick, 20 in a tenth of a second.
    double sense = 1.0;
    int ticks = 0;
    for (; held.guard.is_open() && ticks < 1000; ++ticks) {
        if (std::abs(held.arm.position_mm.x + 0.1 * sense) > 3.0) sense = -sense;
        held.arm.position_mm.x += 0.1 * sense;
        held.tick({2.0 * sense, 0.0, 0.0});
    }
    EXPECT_GT(ticks, 60);
    EXPECT_LT(ticks, 120);
    held.expect_shut(MeasuringEnd::energy);
}

TEST(MeasuringGuard, GoesOnWithTheNextPartWhileThePedalStaysDown) {
    Guarded held;
    held.begin();
    held.guard.shut(MeasuringEnd::done);
    Guarded next = held;
    next.guard = held.guard.again();
    next.tick({0.5, 0.0, 0.0});
    EXPECT_TRUE(next.guard.is_open());
    held.arm.pedal.is_down = false;
    held.tick({0.0, 0.0, 0.0});
    EXPECT_EQ(held.guard.again().end(), MeasuringEnd::pedal_up);
}

}  // namespace
}  // namespace osteomill
