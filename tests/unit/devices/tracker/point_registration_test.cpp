#include <gmock/gmock.h>

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "common/scene/device_mapping.h"
#include "devices/tracker/tracker_file.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A motion and points of it, as a skull's landmarks lie.
struct Registered : ::testing::Test {
    glm::dvec3 random_vector(double within) {
        std::uniform_real_distribution<double> any(-within, within);
        return {any(random), any(random), any(random)};
    }
    DeviceMapping random_motion() {
        std::normal_distribution<double> any;
        const std::array<double, 4> q{any(random), any(random), any(random), any(random)};
        const glm::dquat turn = glm::normalize(glm::dquat(q[0], q[1], q[2], q[3]));
        return {.rotation = glm::mat3_cast(turn), .offset_mm = random_vector(2000.0)};
    }
    std::vector<PointPair> pairs(const DeviceMapping& motion, std::size_t count) {
        std::vector<PointPair> result;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 patient_mm = random_vector(80.0);
            result.push_back(
                {"point " + std::to_string(i), position_in_device_mm(motion, patient_mm), patient_mm});
        }
        return result;
    }

    std::mt19937 random{22};
};

TEST_F(Registered, FindsAnyMotionAgain) {
    for (int run = 0; run < 200; ++run) {
        const DeviceMapping motion = random_motion();
        const PointRegistration found = registered(pairs(motion, 3 + run % 5), 0.01);
        EXPECT_LT(found.rms_mm, 1e-9);
        EXPECT_EQ(found.mapping.scale, 1.0);
        EXPECT_NEAR(glm::determinant(found.mapping.rotation), 1.0, 1e-12);
        const glm::dvec3 anywhere = random_vector(500.0);
        EXPECT_LT(glm::distance(position_in_patient_mm(found.mapping, anywhere),
                                position_in_patient_mm(motion, anywhere)),
                  1e-6);
    }
}

TEST_F(Registered, LeavesTheResidualThatNoiseLeaves) {
    // E(rms^2) = (1 - 2/n) FLE^2 (Sibson 1979; Fitzpatrick, West and Maurer 1998), FLE^2 over three axes.
    constexpr double sigma_mm = 0.3;
    constexpr std::size_t count = 6;
    std::normal_distribution<double> noise(0.0, sigma_mm);
    double sum = 0.0;
    constexpr int runs = 2000;
    for (int run = 0; run < runs; ++run) {
        auto points = pairs(random_motion(), count);
        for (PointPair& point : points)
            point.tracker_mm += glm::dvec3{noise(random), noise(random), noise(random)};
        const double rms_mm = registered(points, 20.0).rms_mm;
        sum += rms_mm * rms_mm;
    }
    const double expected = (1.0 - 2.0 / count) * 3.0 * sigma_mm * sigma_mm;
    EXPECT_NEAR(sum / runs, expected, 0.05 * expected);
}

TEST_F(Registered, NamesThePointThatIsOff) {
    const DeviceMapping motion = random_motion();
    std::vector<PointPair> corners;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 patient_mm(i % 2 * 80.0, i / 2 % 2 * 60.0, i / 4 * 50.0);
        corners.push_back(
            {"point " + std::to_string(i), position_in_device_mm(motion, patient_mm), patient_mm});
    }
    corners[4].tracker_mm += glm::dvec3(0.0, 15.0, 0.0);
    EXPECT_THAT([&] { registered(corners, 2.0); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("point 'point 4' is ")));
    EXPECT_EQ(registered(corners, 20.0).worst, 4u);
}

TEST_F(Registered, RefusesAMirrorImage) {
    auto points = pairs(random_motion(), 5);
    for (PointPair& point : points) point.patient_mm.x = -point.patient_mm.x;
    EXPECT_THAT([&] { registered(points, 2.0); }, ThrowsMessage<std::invalid_argument>(HasSubstr("mm off")));
}

TEST_F(Registered, RefusesTooFewAndThoseOnALine) {
    const DeviceMapping motion = random_motion();
    EXPECT_THAT([&] { registered(pairs(motion, 2), 2.0); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("there are 2 of [[points]]")));
    EXPECT_THAT([&] { registered({}, 2.0); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("three or more")));
    auto points = pairs(motion, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        points[i].patient_mm = glm::dvec3(10.0, 20.0, 30.0) * static_cast<double>(i);
        points[i].tracker_mm = position_in_device_mm(motion, points[i].patient_mm);
    }
    EXPECT_THAT([&] { registered(points, 2.0); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("on one line in the tracker's space")));
    for (PointPair& point : points) point.tracker_mm = point.patient_mm = glm::dvec3(5.0);
    EXPECT_THAT([&] { registered(points, 2.0); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("on one line")));
}

}  // namespace
}  // namespace osteomill
