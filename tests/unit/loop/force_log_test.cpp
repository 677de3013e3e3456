#include "haptic_server/loop/force_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::filesystem::path scratch_file() {
    return std::filesystem::path(::testing::TempDir()) /
           (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
}

std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(ForceLog, WritesALineForEachSampleInOrder) {
    const auto file = scratch_file();
    ForceLog log(file);
    log.push({.time_s = 0.001, .hand_mm = {1, 2, 3}, .force_n = {0.5, 0, 0}, .spindle_on = true});
    log.drain();
    log.push({.time_s = 0.002, .depth_mm = 0.25, .removed_mm3 = 1.5, .fault = Fault::overrun});
    log.close();
    EXPECT_TRUE(log.error().empty());
    std::istringstream lines(text_of(file));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, StartsWith("t_s,hand_x_mm,"));
    EXPECT_THAT(line, HasSubstr(",force_x_n,force_y_n,force_z_n,depth_mm,removed_mm3,spindle,fault"));
    std::getline(lines, line);
    EXPECT_EQ(line,
              "0.0010,1.0000,2.0000,3.0000,0.0000,0.0000,0.0000,0.50000,0.00000,0.00000,0.0000,0.00000,1,0");
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr(",0.2500,1.50000,0,4"));
    EXPECT_FALSE(std::getline(lines, line));
    std::filesystem::remove(file);
}

TEST(ForceLog, CountsWhatFoundTheQueueFull) {
    const auto file = scratch_file();
    ForceLog log(file);
    for (std::size_t i = 0; i < ForceLog::capacity + 5; ++i) log.push({});
    EXPECT_EQ(log.dropped(), 5u);
    log.close();
    std::filesystem::remove(file);
}

TEST(ForceLog, SaysSoWhenTheDiskIsFull) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    ForceLog log("/dev/full");
    for (int i = 0; i < 100; ++i) log.push({});
    log.drain();
    log.close();
    EXPECT_THAT(log.error(), HasSubstr("/dev/full: the log is not complete"));
    EXPECT_THAT(log.error(), HasSubstr("space"));
}

TEST(ForceLog, NamesAFileThatCannotBeCreated) {
    EXPECT_THROW(ForceLog("/nowhere/forces.csv"), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
