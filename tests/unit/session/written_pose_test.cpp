#include "common/session/written_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "common/bone/patient_space.h"
#include "common/session/seen_steps.h"
#include "common/session/tick_sample.h"

namespace osteomill {
namespace {

TEST(WrittenPose, IsItsOwnAndTheTextOfItsDecimals) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 100'000; ++i) {
        const ToolPose pose{{300.0 * normal(random), normal(random), 1e-5 * normal(random)},
                            glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)))};
        const ToolPose written = as_written(pose);
        ASSERT_EQ(as_written(written), written);
        ASSERT_LT(glm::distance(written.position_mm, pose.position_mm), 1e-6);
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_EQ(from_code(to_code(written.position_mm[axis], hand_decimals_mm), hand_decimals_mm),
                      written.position_mm[axis]);
            ASSERT_EQ(from_code(to_code(written.spindle_axis[axis], axis_decimals), axis_decimals),
                      written.spindle_axis[axis]);
        }
        // A reader uses it as a unit vector, unchanged.
        ASSERT_EQ(unit_direction(written.spindle_axis), written.spindle_axis);
    }
}

TEST(WrittenPose, HasNoMinusZeroWhichChangesOfAxesLose) {
    const ToolPose written = as_written({{-0.0, -1e-9, 1.0}, {-0.0, -1e-12, 1.0}});
    EXPECT_FALSE(std::signbit(written.position_mm.x) || std::signbit(written.position_mm.y));
    EXPECT_FALSE(std::signbit(written.spindle_axis.x) || std::signbit(written.spindle_axis.y));
}

TEST(SeenSteps, AreTheirNumbersAgain) {
    using Runs = std::vector<StepRun>;
    using Steps = std::vector<StepTrace>;
    EXPECT_EQ(code_of_steps(Runs{}, 100), 0U);
    EXPECT_EQ(steps_of_code(0, 100), Steps{});
    EXPECT_EQ(steps_of_code(code_of_steps(Runs{{99, 0, 1}}, 100), 100), (Steps{{99, 0}}));
    EXPECT_EQ(steps_of_code(code_of_steps(Runs{{85, 127, 1}, {99, 3, 3}}, 100), 100),
              (Steps{{85, 127}, {99, 3}, {99, 0}, {99, 0}}));
    // The haptic loop stood still.
    Steps many(70, {99, 0});
    many.front().missed = 5;
    EXPECT_EQ(steps_of_code(code_of_steps(Runs{{99, 5, 70}}, 100), 100), many);
    EXPECT_EQ(code_of_steps(Runs{{99, 0, 94}}, 100), steps_not_told);
    EXPECT_EQ(code_of_steps(Runs{{84, 0, 1}}, 100), steps_not_told) << "too late";
    EXPECT_EQ(code_of_steps(Runs{{99, 128, 1}}, 100), steps_not_told) << "too many were missed";
    EXPECT_FALSE(steps_of_code(steps_not_told, 100));
    EXPECT_FALSE(steps_of_code(1, 100)) << "a step without a command";
    EXPECT_FALSE(steps_of_code(1 + 5 * 32, 4)) << "a command before the first tick";
}

}  // namespace
}  // namespace osteomill
