#include "common/scene/device_mapping.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace osteomill {
namespace {

TEST(DeviceMapping, TurnsScalesAndShiftsPositionsAndTurnsForcesBack) {
    DeviceMapping mapping;
    mapping.rotation = glm::dmat3({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});  // device x is patient y
    mapping.scale = 0.5;
    mapping.offset_mm = {10.0, 0.0, 0.0};
    EXPECT_EQ(position_in_patient_mm(mapping, {4.0, 0.0, 0.0}), glm::dvec3(10.0, 2.0, 0.0));
    EXPECT_EQ(direction_in_patient(mapping, {1.0, 0.0, 0.0}), glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(velocity_in_patient_mm_per_s(mapping, {4.0, 0.0, 0.0}), glm::dvec3(0.0, 2.0, 0.0));
    EXPECT_EQ(force_in_device_n(mapping, {0.0, 3.0, 0.0}), glm::dvec3(3.0, 0.0, 0.0)) << "not scaled";
    const glm::dvec3 p(1.0, -7.0, 3.0);
    EXPECT_NEAR(glm::distance(position_in_device_mm(mapping, position_in_patient_mm(mapping, p)), p), 0.0,
                1e-12);
    EXPECT_NEAR(glm::distance(direction_in_device(mapping, direction_in_patient(mapping, p)), p), 0.0, 1e-12);
}

}  // namespace
}  // namespace osteomill
