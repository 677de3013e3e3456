#include "devices/simulated/held_arm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace osteomill::held_arm_test {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

TEST(HeldArm, GoesTheSameWayHoweverOftenItIsRead) {
    const auto position_after = [](int reads) {
        HeldArm arm(ArmModel{}, hand_model(Grip::light), glm::dvec3(0.0));
        arm.set_motor_force({1.0, 0.5, 0.0});
        for (int i = 1; i <= reads; ++i) arm.advance(0.064 * i / reads, glm::dvec3(0.0), up);
        return arm.truth().position_mm();
    };
    const glm::dvec3 once = position_after(1);
    EXPECT_GT(once.x, 0.0);
    EXPECT_EQ(position_after(64), once);
    EXPECT_EQ(position_after(8), once);
}

TEST(HeldArm, DoesNotMoveWhenTimeStandsStill) {
    HeldArm arm(ArmModel{}, hand_model(Grip::firm), glm::dvec3(0.0));
    arm.set_motor_force({3.0, 0.0, 0.0});
    arm.advance(0.0, {50.0, 0.0, 0.0}, up);
    EXPECT_EQ(arm.truth().position_mm(), glm::dvec3(0.0));
}

TEST(HeldArm, GivesNoMoreForceThanItsMotorsHave) {
    const auto position_under = [](double force_n) {
        HeldArm arm(ArmModel{}, hand_model(Grip::firm), glm::dvec3(0.0));
        arm.set_motor_force({force_n, 0.0, 0.0});
        arm.advance(0.05, glm::dvec3(0.0), up);
        return arm.truth().position_mm().x;
    };
    EXPECT_DOUBLE_EQ(position_under(100.0), position_under(3.3));
    EXPECT_LT(position_under(3.0), position_under(3.3));
}

TEST(HeldArm, TakesAForceThatIsNotANumberForNone) {
    HeldArm arm(ArmModel{}, hand_model(Grip::firm), glm::dvec3(0.0));
    arm.set_motor_force({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    arm.advance(0.05, glm::dvec3(0.0), up);
    EXPECT_EQ(arm.truth().position_mm(), glm::dvec3(0.0));
}

TEST(HeldArm, MakesUpForALongPauseInBoundedTime) {
    HeldArm arm(ArmModel{}, hand_model(Grip::firm), glm::dvec3(0.0));
    arm.set_motor_force({1.0, 0.0, 0.0});
    arm.advance(1e6, glm::dvec3(0.0), up);  // would be 5e10 substeps

    HeldArm briefly(ArmModel{}, hand_model(Grip::firm), glm::dvec3(0.0));
    briefly.set_motor_force({1.0, 0.0, 0.0});
    briefly.advance(HeldArm::longest_catch_up_s, glm::dvec3(0.0), up);
    EXPECT_EQ(arm.truth().position_mm(), briefly.truth().position_mm());
}

}  // namespace
}  // namespace osteomill::held_arm_test
