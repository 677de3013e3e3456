#include "devices/position_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::position_sensor_test {
namespace {

TEST(PositionSensor, ReadsWholeEncoderSteps) {
    PositionSensor sensor(0.055);
    sensor.read({0.1, -0.02, 0.03}, 0.001);
    EXPECT_DOUBLE_EQ(sensor.position_mm().x, 2 * 0.055);
    EXPECT_DOUBLE_EQ(sensor.position_mm().y, 0.0);
    EXPECT_DOUBLE_EQ(sensor.position_mm().z, 0.055);
}

TEST(PositionSensor, ReadsExactlyWithoutResolution) {
    PositionSensor sensor(0.0);
    sensor.read({0.1234567, 0.0, 0.0}, 0.001);
    EXPECT_EQ(sensor.position_mm().x, 0.1234567);
}

TEST(PositionSensor, FindsASteadyVelocityThroughItsSteps) {
    PositionSensor sensor(0.055);
    double sum = 0.0;
    int count = 0;
    for (int tick = 0; tick < 1000; ++tick) {
        sensor.read({20.0 * 0.001 * tick, 0.0, 0.0}, 0.001);
        if (tick < 100) continue;
        sum += sensor.velocity_mm_per_s().x;
        ++count;
    }
    EXPECT_NEAR(sum / count, 20.0, 0.2);
}

TEST(PositionSensor, TurnsOneStepIntoLessThanAFifthOfItsBareVelocity) {
    PositionSensor sensor(0.055);
    sensor.read(glm::dvec3(0.0), 0.001);
    sensor.read({0.055, 0.0, 0.0}, 0.001);
    EXPECT_NEAR(sensor.velocity_mm_per_s().x, 55.0 / 6.0, 1e-9);
}

TEST(PositionSensor, StartsAtRestWhereverItStarts) {
    PositionSensor sensor(0.055);
    sensor.read({70.0, 0.0, 0.0}, 0.001);
    EXPECT_EQ(sensor.velocity_mm_per_s().x, 0.0);
}

}  // namespace
}  // namespace osteomill::position_sensor_test
