#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "devices/simulated/held_arm.h"

namespace osteomill::arm_and_hand_test {
namespace {

constexpr double substep_s = ArmAndHand::substep_s;
constexpr double mm_per_m = 1000.0;
const glm::dvec3 x_axis(1.0, 0.0, 0.0);

ArmModel frictionless_arm() {
    return {.coulomb_friction_n = 0.0, .damping_n_s_per_mm = 0.0};
}

HandModel plain_spring(double mass_kg, double stiffness_n_per_mm, double damping_n_s_per_mm) {
    return {.mass_kg = mass_kg,
            .stiffness_n_per_mm = stiffness_n_per_mm,
            .damping_n_s_per_mm = damping_n_s_per_mm,
            .max_push_n = 100.0,
            .correction_hz = 0.0,
            .friction_compensation = 0.0};
}

long long steps_in(double duration_s) {
    return std::llround(duration_s / substep_s);
}

void run(ArmAndHand& motion, double duration_s, const HandTarget& target, const glm::dvec3& force_n) {
    for (long long i = 0; i < steps_in(duration_s); ++i) motion.step(target, force_n);
}

double energy_mj(const ArmAndHand& motion, double mass_kg, double stiffness_n_per_mm) {
    const double speed = glm::length(motion.velocity_mm_per_s());
    const double stretch = glm::length(motion.position_mm());
    return 0.5 * mass_kg / mm_per_m * speed * speed + 0.5 * stiffness_n_per_mm * stretch * stretch;
}

TEST(ArmAndHand, OscillatesFreelyAtTheFrequencyAndDecayOfItsSpringAndDamper) {
    const HandModel hand = plain_spring(0.1, 0.1, 0.0008);
    const double mass_kg = 0.145;
    ArmAndHand motion(frictionless_arm(), hand, 10.0 * x_axis);

    // Periods from the times at which it passes the middle upwards, amplitudes from the peaks between.
    std::vector<double> crossings_s;
    std::vector<double> peaks_mm;
    double before_mm = motion.position_mm().x;
    double peak_mm = 0.0;
    for (long long i = 1; i <= steps_in(3.0); ++i) {
        motion.step({}, glm::dvec3(0.0));
        const double now_mm = motion.position_mm().x;
        peak_mm = std::max(peak_mm, now_mm);
        if (before_mm < 0.0 && now_mm >= 0.0) {
            crossings_s.push_back(substep_s * static_cast<double>(i));
            peaks_mm.push_back(peak_mm);
            peak_mm = 0.0;
        }
        before_mm = now_mm;
    }
    const double omega = std::sqrt(mm_per_m * hand.stiffness_n_per_mm / mass_kg);
    const double decay = mm_per_m * hand.damping_n_s_per_mm / (2.0 * mass_kg);
    const double period_s = 2.0 * std::numbers::pi / std::sqrt(omega * omega - decay * decay);
    ASSERT_GE(crossings_s.size(), 3u);
    EXPECT_NEAR(crossings_s[2] - crossings_s[1], period_s, 0.002 * period_s);
    EXPECT_NEAR(peaks_mm[2] / peaks_mm[1], std::exp(-decay * period_s), 0.005);
}

TEST(ArmAndHand, GivesWayByForceOverStiffness) {
    ArmAndHand motion(frictionless_arm(), plain_spring(0.5, 0.3, 0.02), glm::dvec3(0.0));
    run(motion, 4.0, {}, {0.0, 0.6, -0.3});
    EXPECT_NEAR(motion.position_mm().y, 2.0, 1e-6);
    EXPECT_NEAR(motion.position_mm().z, -1.0, 1e-6);
}

TEST(ArmAndHand, StaysPutUnderLessThanItsFrictionAndSlipsUnderMore) {
    ArmAndHand stuck(ArmModel{}, plain_spring(0.0, 0.0, 0.0), glm::dvec3(0.0));
    run(stuck, 0.5, {}, 0.25 * x_axis);
    EXPECT_EQ(stuck.position_mm(), glm::dvec3(0.0));

    ArmAndHand slipping(ArmModel{}, plain_spring(0.0, 0.0, 0.0), glm::dvec3(0.0));
    run(slipping, 0.1, {}, 0.30 * x_axis);
    // The force left after friction accelerates it: (0.30 - 0.26) N on 45 g for 0.1 s, less a little damping.
    const double distance_mm = 0.5 * mm_per_m * 0.04 / 0.045 * 0.01;
    EXPECT_NEAR(slipping.position_mm().x, distance_mm, 0.1 * distance_mm);
}

TEST(ArmAndHand, IsStoppedByFrictionAloneAfterTheDistanceThatItsEnergyPaysFor) {
    ArmAndHand motion({.damping_n_s_per_mm = 0.0}, plain_spring(0.0, 0.0, 0.0), glm::dvec3(0.0));
    motion.set_velocity(100.0 * x_axis);
    run(motion, 1.0, {}, glm::dvec3(0.0));
    EXPECT_EQ(motion.velocity_mm_per_s(), glm::dvec3(0.0));
    const double distance_mm = 0.5 * 0.045 / mm_per_m * 100.0 * 100.0 / 0.26;
    EXPECT_NEAR(motion.position_mm().x, distance_mm, 0.01 * distance_mm);
}

TEST(ArmAndHand, NeverGainsEnergyWhileNobodyPushes) {
    const HandModel hand = plain_spring(0.5, 0.3, 0.005);
    ArmAndHand motion(ArmModel{}, hand, {3.0, -8.0, 1.0});
    motion.set_velocity({-50.0, 20.0, 90.0});
    const double mass_kg = 0.545;
    double before_mj = energy_mj(motion, mass_kg, hand.stiffness_n_per_mm);
    for (long long i = 0; i < steps_in(2.0); ++i) {
        motion.step({}, glm::dvec3(0.0));
        const double now_mj = energy_mj(motion, mass_kg, hand.stiffness_n_per_mm);
        // Symplectic Euler's energy wavers by omega dt / 2 of itself, here 2e-4.
        ASSERT_LE(now_mj, before_mj + 3e-4 * before_mj) << "substep " << i;
        before_mj = now_mj;
    }
    EXPECT_LT(glm::length(motion.velocity_mm_per_s()), 1e-9);
}

TEST(ArmAndHand, PushesHarderUntilItsDepthIsRight) {
    HandModel hand = hand_model(Grip::firm);
    ArmAndHand motion(frictionless_arm(), hand, glm::dvec3(0.0));
    run(motion, 6.0, {}, {0.0, 0.0, 0.9});
    EXPECT_NEAR(motion.position_mm().z, 0.0, 0.01) << "0.9 N would displace it by 3 mm";
}

TEST(ArmAndHand, DoesNotCorrectAcrossItsSpindle) {
    ArmAndHand motion(frictionless_arm(), hand_model(Grip::firm), glm::dvec3(0.0));
    run(motion, 6.0, {}, 0.9 * x_axis);
    EXPECT_NEAR(motion.position_mm().x, 3.0, 0.01);
}

TEST(ArmAndHand, GivesInToMoreThanItsStrongestPush) {
    const HandModel hand = hand_model(Grip::firm);
    ArmAndHand motion(frictionless_arm(), hand, glm::dvec3(0.0));
    run(motion, 2.0, {}, (hand.max_push_n + 0.1) * x_axis);
    EXPECT_GT(motion.position_mm().x, 2.0 * hand.max_push_n / hand.stiffness_n_per_mm);
}

TEST(ArmAndHand, TrailsLessWhenTheHandKnowsTheFriction) {
    const auto lag_mm = [](double compensation) {
        HandModel hand = hand_model(Grip::firm);
        hand.friction_compensation = compensation;
        ArmAndHand motion(ArmModel{}, hand, glm::dvec3(0.0));
        const glm::dvec3 velocity = 5.0 * x_axis;
        double time_s = 0.0;
        for (long long i = 0; i < steps_in(3.0); ++i) {
            time_s += substep_s;
            motion.step({time_s * velocity, velocity}, glm::dvec3(0.0));
        }
        return 5.0 * time_s - motion.position_mm().x;
    };
    EXPECT_NEAR(lag_mm(0.0), 0.26 / 0.3, 0.1);
    EXPECT_LT(lag_mm(0.9), 0.2);
}

}  // namespace
}  // namespace osteomill::arm_and_hand_test
