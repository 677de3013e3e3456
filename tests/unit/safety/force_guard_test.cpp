#include "simulation/safety/force_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace osteomill::force_guard_test {
namespace {

constexpr double tick_s = 0.001;
constexpr double limit_n = 3.3;
using State = ForceGuard::State;

int ticks_in(double duration_s) {
    return static_cast<int>(std::lround(duration_s / tick_s));
}

/// A guard that has come to feel a steady force.
ForceGuard guard_feeling(const glm::dvec3& force_n) {
    ForceGuard guard(limit_n);
    for (int i = 0; i < 20; ++i) guard.tick(force_n, Fault::none, tick_s);
    return guard;
}

TEST(ForceGuard, LetsAForceWithinItsLimitsThrough) {
    ForceGuard guard(limit_n);
    EXPECT_EQ(guard.tick({0.5, -0.3, 0.1}, Fault::none, tick_s), glm::dvec3(0.5, -0.3, 0.1));
    EXPECT_EQ(guard.tick(glm::dvec3(0.0), Fault::none, tick_s), glm::dvec3(0.0));
}

TEST(ForceGuard, ClampsToTheDevicesLimitAndKeepsTheDirection) {
    ForceGuard guard = guard_feeling({300.0, 400.0, 0.0});
    const glm::dvec3 force = guard.tick({300.0, 400.0, 0.0}, Fault::none, tick_s);
    EXPECT_NEAR(force.x, 0.6 * limit_n, 1e-12);
    EXPECT_NEAR(force.y, 0.8 * limit_n, 1e-12);
}

TEST(ForceGuard, ClampsForcesTooLargeToSquare) {
    ForceGuard guard = guard_feeling({0.0, 0.0, 1e300});
    EXPECT_NEAR(guard.tick({0.0, 0.0, 1e300}, Fault::none, tick_s).z, limit_n, 1e-12);
}

TEST(ForceGuard, LimitsHowFastTheForceChanges) {
    ForceGuard guard = guard_feeling({0.0, 3.0, 0.0});
    const glm::dvec3 force = guard.tick({0.0, -3.0, 0.0}, Fault::none, tick_s);
    EXPECT_NEAR(force.y, 3.0 - ForceGuard::slew_n_per_s * tick_s, 1e-12);
}

TEST(ForceGuard, TakesAForceThatIsNotANumberForAFault) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL}) {
        ForceGuard guard = guard_feeling({1.0, 0.0, 0.0});
        const glm::dvec3 force = guard.tick({0.0, bad, 0.0}, Fault::none, tick_s);
        EXPECT_LT(glm::length(force), 1.0);
        EXPECT_EQ(guard.fault(), Fault::not_a_number);
    }
}

TEST(ForceGuard, FadesToZeroWithinFiftyMillisecondsOfAnyFaultAndNeverRises) {
    for (const Fault fault : all_faults) {
        ForceGuard guard = guard_feeling({2.0, 1.0, -2.0});
        double before_n = 3.0;
        double elapsed_s = 0.0;
        while (before_n > 0.0) {
            const double now_n = glm::length(guard.tick({2.0, 1.0, -2.0}, fault, tick_s));
            ASSERT_LT(now_n, before_n);
            ASSERT_LE(before_n - now_n, ForceGuard::slew_n_per_s * tick_s);
            before_n = now_n;
            elapsed_s += tick_s;
        }
        EXPECT_LE(elapsed_s, 0.05);
        EXPECT_EQ(guard.fault(), fault);
        EXPECT_FALSE(guard.is_engaged());
    }
}

TEST(ForceGuard, StaysOffWhileTheFaultLasts) {
    ForceGuard guard = guard_feeling({1.0, 0.0, 0.0});
    for (int i = 0; i < 2000; ++i) guard.tick({1.0, 0.0, 0.0}, Fault::device_lost, tick_s);
    EXPECT_EQ(guard.state(), State::off);
}

TEST(ForceGuard, StaysOffInALateTickThatBringsAFault) {
    ForceGuard guard = guard_feeling({1.0, 0.0, 0.0});
    for (int i = 0; i < 100; ++i) guard.tick({1.0, 0.0, 0.0}, Fault::device_lost, tick_s);
    guard.tick({1.0, 0.0, 0.0}, Fault::overrun, 10.0 * ForceGuard::settle_s);
    EXPECT_EQ(guard.state(), State::off);
    EXPECT_EQ(guard.fault(), Fault::overrun);
}

TEST(ForceGuard, FinishesFadingAlthoughTheFaultHasGone) {
    ForceGuard guard = guard_feeling({1.0, 0.0, 0.0});
    guard.tick({1.0, 0.0, 0.0}, Fault::overrun, tick_s);
    for (int i = 0; i < ticks_in(ForceGuard::fade_out_s); ++i) {
        EXPECT_LT(guard.tick({1.0, 0.0, 0.0}, Fault::none, tick_s).x, 1.0);
    }
    EXPECT_EQ(guard.state(), State::off);
}

TEST(ForceGuard, ComesBackWithoutAJump) {
    ForceGuard guard = guard_feeling({3.0, 0.0, 0.0});
    guard.tick({3.0, 0.0, 0.0}, Fault::model_stalled, tick_s);
    double before_n = 3.0;
    int ticks = 0;
    for (; guard.state() != State::active && ticks < 2000; ++ticks) {
        const double now_n = guard.tick({3.0, 0.0, 0.0}, Fault::none, tick_s).x;
        if (guard.is_engaged()) {
            EXPECT_LE(now_n - before_n, 3.0 * tick_s / ForceGuard::fade_in_s + 1e-9);
        }
        before_n = now_n;
    }
    EXPECT_NEAR(before_n, 3.0, 0.05);
    EXPECT_GE(ticks * tick_s, ForceGuard::settle_s + ForceGuard::fade_in_s);
    EXPECT_EQ(guard.fault(), Fault::none);
}

TEST(ForceGuard, FadesOutFromWhereAFadeInHadGotTo) {
    ForceGuard guard = guard_feeling({3.0, 0.0, 0.0});
    guard.tick({3.0, 0.0, 0.0}, Fault::overrun, tick_s);
    double force_n = 3.0;
    while (guard.state() != State::fading_in) guard.tick({3.0, 0.0, 0.0}, Fault::none, tick_s);
    for (int i = 0; i < 50; ++i) force_n = guard.tick({3.0, 0.0, 0.0}, Fault::none, tick_s).x;
    EXPECT_GT(force_n, 0.1);
    EXPECT_LT(guard.tick({3.0, 0.0, 0.0}, Fault::overrun, tick_s).x, force_n);
    EXPECT_EQ(guard.state(), State::fading_out);
}

/// Any wanted force and any fault, at random but repeatable, for two minutes of ticks: whatever happens, the
/// force is finite, within the limit and the rate, and falls to zero and stays there while a fault lasts.
TEST(ForceGuard, KeepsItsPromisesUnderAnySequenceOfFaults) {
    std::mt19937 random(20240521);
    std::uniform_real_distribution<double> size(-20.0, 20.0);
    std::uniform_int_distribution<int> percent(0, 999);
    ForceGuard guard(limit_n);
    glm::dvec3 before_n(0.0);
    Fault fault = Fault::none;
    double fault_began_s = 0.0;
    for (int i = 0; i < 120'000; ++i) {
        const double now_s = tick_s * i;
        if (percent(random) < (fault == Fault::none ? 2 : 10)) {
            fault = fault == Fault::none ? all_faults[static_cast<std::size_t>(percent(random)) % 5]
                                         : Fault::none;
            fault_began_s = now_s;
        }
        const glm::dvec3 wanted =
            percent(random) == 0 ? glm::dvec3(NAN) : glm::dvec3(size(random), size(random), size(random));
        const glm::dvec3 force = guard.tick(wanted, fault, tick_s);
        ASSERT_TRUE(std::isfinite(glm::length(force)));
        ASSERT_LE(glm::length(force), limit_n * (1.0 + 1e-12));
        ASSERT_LE(glm::distance(force, before_n), ForceGuard::slew_n_per_s * tick_s * (1.0 + 1e-9));
        if (fault != Fault::none && now_s - fault_began_s > 0.05) {
            ASSERT_EQ(force, glm::dvec3(0.0));
        }
        before_n = force;
    }
}

}  // namespace
}  // namespace osteomill::force_guard_test
