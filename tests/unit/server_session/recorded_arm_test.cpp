#include "haptic_server/session/recorded_arm.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

class RecordedArmTest : public ::testing::Test {
  protected:
    std::filesystem::path trajectory(const std::string& first_line) {
        std::ofstream(folder_ / "hand.csv")
            << first_line << "\nt_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0,0,0,0,0,1,0\n";
        return folder_ / "hand.csv";
    }
    std::string refusal_of(const std::string& first_line) {
        try {
            arm_of_trajectory(trajectory(first_line));
        } catch (const std::runtime_error& error) {
            const std::string line = error.what();
            const std::string place = (folder_ / "hand.csv").string() + ":1: ";
            EXPECT_TRUE(line.starts_with(place)) << line;
            return line.substr(std::min(place.size(), line.size()));
        }
        return "";
    }

    testing::TemporaryFolder folder_;
};

TEST_F(RecordedArmTest, OfATrajectoryIsTheOneThatTheRecordingNames) {
    const DeviceLimits arm{.max_force_n = 7.9,
                           .max_stiffness_n_per_mm = 2.3,
                           .apparent_mass_kg = 0.1,
                           .position_resolution_mm = 0.0123456789012345,
                           .damping_n_s_per_mm = 0.006,
                           .gives_force = false};
    const auto read = arm_of_trajectory(trajectory("# arm " + arm_settings(arm).dump()));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->max_force_n, arm.max_force_n);
    EXPECT_EQ(read->max_stiffness_n_per_mm, arm.max_stiffness_n_per_mm);
    EXPECT_EQ(read->apparent_mass_kg, arm.apparent_mass_kg);
    EXPECT_EQ(read->position_resolution_mm, arm.position_resolution_mm);
    EXPECT_EQ(read->damping_n_s_per_mm, arm.damping_n_s_per_mm);
    EXPECT_FALSE(read->gives_force);
}

TEST_F(RecordedArmTest, IsNoneInATrajectoryThatNamesNone) {
    EXPECT_FALSE(arm_of_trajectory(trajectory("# made by hand, for an arm")));
}

TEST_F(RecordedArmTest, ThatCannotBeIsRefusedInOneLine) {
    const std::string incomplete = "does not say what the arm can do, as a recording's setting 'arm' does";
    EXPECT_EQ(refusal_of("# arm of Anna"), incomplete);
    EXPECT_EQ(refusal_of("# arm {\"max_force_n\": 3}"), incomplete);
    auto arm = arm_settings({});
    arm["max_force_n"] = "strong";
    EXPECT_EQ(refusal_of("# arm " + arm.dump()), incomplete);
    arm = arm_settings({.apparent_mass_kg = 0.0});
    EXPECT_EQ(refusal_of("# arm " + arm.dump()),
              "the arm's force, stiffness and mass must be above 0, its resolution and damping 0 or more");
    EXPECT_NE(refusal_of("# arm " + std::string(100'000, '[')).find("deep"), std::string::npos);
}

}  // namespace
}  // namespace osteomill
