#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "devices/simulated/trajectory.h"
#include "tests/support/message_of.h"

namespace osteomill::csv_trajectory_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string header = "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";

std::vector<Waypoint> read(const std::string& text) {
    return read_trajectory_csv(text, "path.csv", 3);
}

std::string error_of(const std::string& text) {
    return testing::message_of<std::runtime_error>([&] { read(text); });
}

TEST(CsvTrajectory, ReadsPosesAndPedal) {
    const auto waypoints = read(header + "0,1,2,3,0,0,2,0\n0.5,1.5,-2e0,3,0,0,1,1\n");
    ASSERT_EQ(waypoints.size(), 2u);
    EXPECT_EQ(waypoints[0].pose.position_mm, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(waypoints[0].pose.spindle_axis, glm::dvec3(0.0, 0.0, 1.0)) << "normalised";
    EXPECT_FALSE(waypoints[0].pedal);
    EXPECT_EQ(waypoints[1].time_s, 0.5);
    EXPECT_EQ(waypoints[1].pose.position_mm.y, -2.0);
    EXPECT_TRUE(waypoints[1].pedal);
    EXPECT_FALSE(waypoints[1].burr.has_value());
}

TEST(CsvTrajectory, ReadsTheBurrWhereThereIsSuchAColumn) {
    const auto waypoints = read("t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr\n0,0,0,0,0,0,1,1,2\n");
    EXPECT_EQ(waypoints.at(0).burr, 2u);
}

TEST(CsvTrajectory, TakesWindowsLineEndsCommentsAndBlankLines) {
    const auto waypoints = read("# made by hand\r\n" + header.substr(0, header.size() - 1) +
                                "\r\n\r\n# rest\r\n0, 0, 0, 0, 0, 0, 1, 0\r\n");
    EXPECT_EQ(waypoints.size(), 1u);
}

TEST(CsvTrajectory, NamesFileAndLineOfWhatIsWrong) {
    EXPECT_THAT(error_of(""), StartsWith("path.csv:1: the first line must be t_s,"));
    EXPECT_THAT(error_of("0,0,0,0,0,0,1,0\n"), StartsWith("path.csv:1: the first line must be"));
    EXPECT_THAT(error_of(header), HasSubstr("no waypoint"));
    EXPECT_THAT(error_of(header + "0,0,0,0,0,0,1\n"), StartsWith("path.csv:2: has 7 columns"));
    EXPECT_THAT(error_of(header + "\n0,0,zero,0,0,0,1,0\n"), StartsWith("path.csv:3: 'zero' is not"));
    EXPECT_THAT(error_of(header + "0,0,nan,0,0,0,1,0\n"), StartsWith("path.csv:2: 'nan' is not"));
    EXPECT_THAT(error_of(header + "0,0,1e999,0,0,0,1,0\n"), StartsWith("path.csv:2: '1e999' is not"));
    EXPECT_THAT(error_of(header + "0,0,0,0,0,0,0,0\n"), StartsWith("path.csv:2: axis_x"));
    EXPECT_THAT(error_of(header + "0,0,0,0,0,0,1,yes\n"), StartsWith("path.csv:2: pedal must be 0 or 1"));
    EXPECT_THAT(error_of(header + "0,0,0,0,0,0,1,0\n0,1,0,0,0,0,1,0\n"), StartsWith("path.csv:3: t_s must"));
    EXPECT_THAT(error_of("t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr\n0,0,0,0,0,0,1,1,3\n"),
                HasSubstr("0 to 2"));
}

TEST(CsvTrajectory, NamesAFileThatIsNotThere) {
    EXPECT_THROW(
        {
            try {
                read_trajectory_csv("/nowhere/path.csv", 1);
            } catch (const std::runtime_error& error) {
                EXPECT_THAT(error.what(), StartsWith("/nowhere/path.csv: "));
                throw;
            }
        },
        std::runtime_error);
}

}  // namespace
}  // namespace osteomill::csv_trajectory_test
