#include "simulation/safety/energy_meter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::energy_meter_test {
namespace {

constexpr double tick_s = 0.001;
constexpr double longest_mm = 3.0;
const glm::dvec3 one_newton(1.0, 0.0, 0.0);

TEST(EnergyMeter, CountsWhatAForceGivesAHandThatGoesWithIt) {
    EnergyMeter meter;
    for (int i = 0; i <= 50; ++i) meter.add({0.1 * i, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_NEAR(meter.lately_mj(), 5.0, 1e-12);
    EXPECT_NEAR(meter.most_mj(), 5.0, 1e-12);
}

TEST(EnergyMeter, TakesOffWhatTheHandPutIn) {
    EnergyMeter meter;
    for (int i = 0; i <= 20; ++i) meter.add({0.1 * i, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    for (int i = 20; i-- > 0;) meter.add({0.1 * i, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_NEAR(meter.lately_mj(), 0.0, 1e-12);
    EXPECT_NEAR(meter.most_mj(), 2.0, 1e-12) << "on the way";
}

TEST(EnergyMeter, ForgetsWhatIsOlderThanItsWindow) {
    EnergyMeter meter;
    for (int i = 0; i <= 500; ++i) meter.add({0.1 * i, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_NEAR(meter.lately_mj(), 10.0, 1e-9) << "of 100 ticks";
    for (int i = 0; i < 100; ++i) meter.add({50.0, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_EQ(meter.lately_mj(), 0.0);
    EXPECT_NEAR(meter.most_mj(), 50.0, 1e-9) << "since the start";
}

TEST(EnergyMeter, CountsLateTicksByTheirTime) {
    EnergyMeter meter;
    for (int i = 0; i <= 500; ++i) meter.add({0.1 * i, 0.0, 0.0}, one_newton, 10.0 * tick_s, longest_mm);
    EXPECT_NEAR(meter.lately_mj(), 1.0, 1e-9) << "ten ticks of ten milliseconds";
}

TEST(EnergyMeter, IsNotDeceivedByAJumpOrByWhatIsNoNumber) {
    EnergyMeter meter;
    meter.add({1000.0, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_EQ(meter.most_mj(), 0.0) << "the first position is no way";
    meter.add({1010.0, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    meter.add({NAN, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    meter.add({1011.0, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_EQ(meter.most_mj(), 0.0);
    meter.add({1012.0, 0.0, 0.0}, one_newton, tick_s, longest_mm);
    EXPECT_NEAR(meter.lately_mj(), 1.0, 1e-12) << "and goes on";
}

}  // namespace
}  // namespace osteomill::energy_meter_test
