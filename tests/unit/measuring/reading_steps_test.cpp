#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <random>

#include "devices/hid/arm_kinematics.h"
#include "devices/hid/arm_profile.h"
#include "haptic_server/measuring/arm_estimates.h"

namespace osteomill {
namespace {

/// A hand that moves a millimetre or so to and fro in all directions.
glm::dvec3 hand_mm(std::size_t tick) {
    const double t = 2.0 * std::numbers::pi * 0.001 * static_cast<double>(tick);
    return {1.2 * std::sin(1.1 * t), 0.9 * std::sin(0.7 * t + 1.0), 1.1 * std::sin(1.7 * t + 2.0)};
}

std::vector<MeasuredTick> readings(double step_mm, double noise_mm, bool moves = true) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, noise_mm > 0.0 ? noise_mm : 1.0);
    std::vector<MeasuredTick> ticks(3000);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        glm::dvec3 x_mm = moves ? hand_mm(i) : glm::dvec3(0.4, 0.1, -0.3);
        if (noise_mm > 0.0) x_mm += glm::dvec3(noise(random), noise(random), noise(random));
        ticks[i].position_mm = step_mm > 0.0 ? step_mm * glm::round(x_mm / step_mm) : x_mm;
    }
    return ticks;
}

TEST(EncoderStep, IsWhatAReadingMovesBy) {
    for (const double step_mm : {0.005, 0.02, 0.055, 0.1})
        EXPECT_NEAR(encoder_step_mm(readings(step_mm, 0.0)), step_mm, 1e-9);
}

TEST(EncoderStep, IsSeenThroughNoise) {
    for (const double noise_mm : {0.002, 0.02, 0.08})
        EXPECT_NEAR(encoder_step_mm(readings(0.02, noise_mm)), 0.02, 1e-9) << noise_mm;
}

TEST(EncoderStep, IsNoneWhereReadingsAreContinuous) {
    EXPECT_EQ(encoder_step_mm(readings(0.0, 0.0)), 0.0);
    EXPECT_EQ(encoder_step_mm(readings(0.0, 0.01)), 0.0);
    EXPECT_EQ(encoder_step_mm(readings(0.05, 0.0, false)), 0.0) << "nothing moved";
    EXPECT_EQ(encoder_step_mm({}), 0.0);
}

TEST(EncoderStep, OfAnArmOfThreeEncodersIsThatOfOneOfThem) {
    // A count of each moves the tip by another length, in another direction.
    const ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    const ArmKinematics kinematics(profile);
    std::vector<MeasuredTick> ticks(3000);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const glm::dvec3 counts = glm::round(20.0 * hand_mm(i));
        std::array<int, 3> at = profile.home_counts;
        for (int k = 0; k < 3; ++k) at[static_cast<std::size_t>(k)] += static_cast<int>(counts[k]);
        ticks[i].position_mm = kinematics.position_mm(kinematics.angles_rad(at));
    }
    const double step_mm = encoder_step_mm(ticks);
    EXPECT_LE(step_mm, 1.01 * kinematics.resolution_mm());
    EXPECT_GE(step_mm, 0.5 * kinematics.resolution_mm());
}

TEST(ReadingNoise, IsItsDeviation) {
    for (const double noise_mm : {0.001, 0.01}) {
        EXPECT_NEAR(reading_noise_mm(readings(0.0, noise_mm, false)), noise_mm, 0.15 * noise_mm);
        EXPECT_NEAR(reading_noise_mm(readings(0.0, noise_mm)), noise_mm, 0.15 * noise_mm)
            << "of a hand that sways";
    }
    EXPECT_EQ(reading_noise_mm(readings(0.055, 0.0, false)), 0.0);
}

}  // namespace
}  // namespace osteomill
