#include "simulation/coupling/feed_forward.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "simulation/coupling/implicit_coupling.h"
#include "tests/support/lockstep.h"

namespace osteomill::feed_forward_test {
namespace {

constexpr double tick_s = 0.001;
constexpr double spring_n_per_mm = 1.5;

PatientLimits arm() {
    return {.max_stiffness_n_per_mm = spring_n_per_mm};
}

/// A hand that goes steadily along x, in bone whose resistance is a function of the time, on a spring whose
/// burr is held by that bone: one dimension, backward Euler.
struct Bench {
    FeedForward feed_forward{arm()};
    double speed_mm_per_s = 20.0;
    double time_s = 0.0;
    double spring_n = 0.0;  ///< against the way
    double felt_n = 0.0;    ///< the same, with what is fed forward

    void tick(double resistance_n_s_per_mm) {
        const glm::dvec3 step_mm = feed_forward.follow_hand({speed_mm_per_s * time_s, 0.0, 0.0}, tick_s);
        EXPECT_EQ(step_mm.y, 0.0);
        time_s += tick_s;
        // K (x - p) = B dp/dt
        const double share = spring_n_per_mm * tick_s / (resistance_n_s_per_mm + spring_n_per_mm * tick_s);
        spring_n = (1.0 - share) * (spring_n + spring_n_per_mm * speed_mm_per_s * tick_s);
        felt_n = spring_n - feed_forward.tick(resistance_n_s_per_mm, {-spring_n, 0.0, 0.0}, tick_s).x;
    }
};

TEST(FeedForward, AndTheSpringTogetherAreTheRigidBurrs) {
    Bench bench;
    for (int i = 0; i < 100; ++i) bench.tick(0.0);
    EXPECT_EQ(bench.felt_n, 0.0) << "in air";
    // 80 N s/m, met over a third of a millimetre: the spring alone takes 53 ms.
    double spring_after_20_ms_n = 0.0;
    for (int i = 1; i <= 40; ++i) {
        bench.tick(0.08 * std::min(1.0, i / 17.0));
        if (i == 20) spring_after_20_ms_n = bench.spring_n;
        if (i < 20) continue;
        EXPECT_NEAR(bench.felt_n, 1.6, 0.2) << i;
    }
    EXPECT_LT(spring_after_20_ms_n, 0.5);
    for (int i = 0; i < 500; ++i) bench.tick(0.08);
    EXPECT_NEAR(bench.felt_n, 1.6, 0.01);
}

TEST(FeedForward, IsZeroInBoneThatResistsEvenly) {
    // Whatever the hand does, and though the lattice makes the resistance ripple by a tenth.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (const double resistance_n_s_per_mm : {0.005, 0.04, 0.3, 1.75}) {
        FeedForward feed_forward(arm());
        feed_forward.place(glm::dvec3(0.0));
        glm::dvec3 hand_mm(0.0);
        for (int i = 0; i < 500; ++i) {
            (void)feed_forward.follow_hand(hand_mm, tick_s);
            (void)feed_forward.tick(resistance_n_s_per_mm, glm::dvec3(0.0), tick_s);
        }
        for (int i = 0; i < 2000; ++i) {
            hand_mm += 0.05 * glm::dvec3(any(random), any(random), any(random));
            (void)feed_forward.follow_hand(hand_mm, tick_s);
            const double now_n_s_per_mm = resistance_n_s_per_mm * (1.0 + 0.1 * any(random));
            const glm::dvec3 spring_n(any(random), any(random), any(random));
            ASSERT_EQ(feed_forward.tick(now_n_s_per_mm, spring_n, tick_s), glm::dvec3(0.0)) << i;
        }
    }
}

TEST(FeedForward, StaysWithinItsBoundsWhateverComes) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    FeedForward feed_forward(arm());
    glm::dvec3 hand_mm(0.0), velocity_mm_per_s(0.0), spring_n(0.0), spring_before_n(0.0), before_n(0.0);
    double resistance_n_s_per_mm = 0.0, tends_to_n_s_per_mm = 0.0, largest_n = 0.0;
    for (int i = 0; i < 200'000; ++i) {
        // Jolts, reversals, bone that comes and goes, a spring that jumps; and now and then a late tick.
        if (i % 170 == 0) velocity_mm_per_s = 150.0 * glm::dvec3(any(random), any(random), any(random));
        if (i % 110 == 0) tends_to_n_s_per_mm = std::max(0.0, std::exp(3.0 * any(random)) - 0.5);
        // At once, or over many ticks.
        resistance_n_s_per_mm += i % 2200 < 1100
                                     ? tends_to_n_s_per_mm - resistance_n_s_per_mm
                                     : std::clamp(tends_to_n_s_per_mm - resistance_n_s_per_mm, -0.01, 0.01);
        spring_n = 0.8 * spring_n + 0.3 * glm::dvec3(any(random), any(random), any(random));
        const double late_s = i % 1000 == 999 ? 0.03 : tick_s;
        hand_mm += late_s * velocity_mm_per_s;
        const glm::dvec3 way_mm = feed_forward.follow_hand(hand_mm, late_s);
        const glm::dvec3 way = glm::normalize(way_mm);
        const double rigid_n = resistance_n_s_per_mm * glm::length(way_mm) / late_s;
        const glm::dvec3 force_n = feed_forward.tick(resistance_n_s_per_mm, spring_n, late_s);
        const glm::dvec3 step_n = force_n - before_n;
        const glm::dvec3 of_spring_n = spring_n - spring_before_n;
        ASSERT_LE(glm::length(step_n), 0.1 + 1e-9) << i;
        ASSERT_LE(glm::length(step_n + of_spring_n), std::max(0.15, glm::length(of_spring_n)) + 1e-9) << i;
        // It only resists, and what exceeds the rigid burr's force is on its way out.
        const double against_n = -glm::dot(force_n, way);
        if (glm::length(force_n) > glm::length(before_n)) {
            ASSERT_GT(against_n, 0.0) << i;
            ASSERT_LE(against_n + std::abs(glm::dot(spring_n, way)), rigid_n + 1e-9) << i;
        }
        largest_n = std::max(largest_n, glm::length(force_n));
        before_n = force_n;
        spring_before_n = spring_n;
    }
    EXPECT_GT(largest_n, 0.5) << "there was something to bound";
}

/// A hand on rails, which goes up and down in a block.
struct Journey {
    double taken_mj = 0.0;       ///< by the force on the hand
    double most_given_mj = 0.0;  ///< to the hand, from any moment to any later one
    double largest_step_n = 0.0;
    double peak_n = 0.0;
    glm::dvec3 last_n{0.0};
};

Journey journey(bool feed_forward, double speed_mm_per_s) {
    Burr burr{.name = "3 mm", .diameter_mm = 3.0};
    burr.spindle_rev_per_s = 40'000.0 / 60.0;
    ImplicitCoupling coupling(
        {.device = {.max_stiffness_n_per_mm = spring_n_per_mm}, .feed_forward = feed_forward});
    testing::Lockstep loop(coupling, testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 0.0}, 0.1), burr, 1);
    Journey found;
    glm::dvec3 before_mm(0.0, 0.0, 2.0);
    double most_taken_mj = 0.0;
    // By 1 mm, five times, each a third of a millimetre farther; `speed_mm_per_s` at most.
    const double half_s = 0.5 * glm::pi<double>() / speed_mm_per_s;
    for (int tick = 0; tick * tick_s < 10.0 * half_s + 0.1; ++tick) {
        const double halves = std::min(tick * tick_s / half_s, 10.0);
        const double down_mm = 0.5 - 0.5 * std::cos(glm::pi<double>() * halves);
        const glm::dvec3 hand_mm(std::floor(0.5 * halves) / 3.0, 0.013, 2.0 - down_mm);
        found.taken_mj -= glm::dot(found.last_n, hand_mm - before_mm);
        most_taken_mj = std::max(most_taken_mj, found.taken_mj);
        found.most_given_mj = std::max(found.most_given_mj, most_taken_mj - found.taken_mj);
        before_mm = hand_mm;
        const glm::dvec3 force_n = loop.tick(hand_mm, true).force_n;
        found.largest_step_n = std::max(found.largest_step_n, glm::distance(force_n, found.last_n));
        found.peak_n = std::max(found.peak_n, glm::length(force_n));
        found.last_n = force_n;
    }
    return found;
}

TEST(FeedForward, IsFeltAtTheOnsetAndGivesTheHandNoEnergyForIt) {
    for (const double speed_mm_per_s : {5.0, 20.0, 60.0}) {
        const Journey without = journey(false, speed_mm_per_s);
        const Journey with = journey(true, speed_mm_per_s);
        EXPECT_GT(with.peak_n, without.peak_n) << speed_mm_per_s;
        EXPECT_GT(with.taken_mj, without.taken_mj) << speed_mm_per_s;
        EXPECT_LT(with.most_given_mj, without.most_given_mj + 0.2) << speed_mm_per_s;
        EXPECT_LE(with.largest_step_n, std::max(0.15, without.largest_step_n) + 1e-9) << speed_mm_per_s;
        EXPECT_EQ(with.last_n, glm::dvec3(0.0)) << "in air, at rest";
    }
}

TEST(FeedForward, IsOffUnlessSomebodyAsks) {
    EXPECT_FALSE(CouplingOptions{}.feed_forward);
    EXPECT_FALSE(Scene{}.feed_forward);
}

}  // namespace
}  // namespace osteomill::feed_forward_test
