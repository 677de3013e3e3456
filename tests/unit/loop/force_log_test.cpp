#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "analysis/logs/csv_log.h"
#include "simulation/safety/fault.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/file_text.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::text_of;

std::filesystem::path scratch_file() {
    return std::filesystem::path(::testing::TempDir()) /
           (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
}

TEST(ForceLog, WritesALineForEachSampleInOrder) {
    const auto file = scratch_file();
    ForceLog log(file);
    log.push({.time_s = 0.001, .hand_mm = {1, 2, 3}, .force_n = {0.5, 0, 0}, .spindle_on = true});
    log.drain();
    log.push({.time_s = 0.002,
              .depth_mm = 0.25,
              .removed_mm3 = 1.5,
              .fault = static_cast<std::uint8_t>(Fault::overrun)});
    log.close();
    EXPECT_TRUE(log.error().empty());
    std::istringstream lines(text_of(file));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, StartsWith("t_s,hand_x_mm,"));
    EXPECT_THAT(line, HasSubstr(",force_x_n,force_y_n,force_z_n,depth_mm,removed_mm3,spindle,fault"));
    std::getline(lines, line);
    EXPECT_EQ(
        line,
        "0.0010,1.000000,2.000000,3.000000,0.0000,0.0000,0.0000,0.50000,0.00000,0.00000,0.0000,0.00000,1,0");
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr(",0.2500,1.50000,0,4"));
    EXPECT_FALSE(std::getline(lines, line));
    std::filesystem::remove(file);
}

TEST(ForceLog, HasTheTorqueOfAShankWhereThereIsOne) {
    const auto file = scratch_file();
    ForceLog log(file, TickSample::header_line(true));
    log.push({.time_s = 0.001, .shank_torque_n_mm = glm::dvec3(1.5, -2.0, 0.25)});
    log.close();
    std::istringstream lines(text_of(file));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr(",fault,shank_torque_x_n_mm,shank_torque_y_n_mm,shank_torque_z_n_mm"));
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr(",0,0,1.5000,-2.0000,0.2500"));
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

TEST(ForceLog, LeavesTheOldFileUntilItIsClosed) {
    const auto file = scratch_file();
    std::ofstream(file) << "old";
    {
        ForceLog log(file);
        log.push({});
        log.drain_all();
        EXPECT_EQ(text_of(file), "old");
        log.close();
    }
    EXPECT_THAT(text_of(file), StartsWith("t_s,"));
    EXPECT_FALSE(std::filesystem::exists(part_of(file)));
    std::filesystem::remove(file);
}

TEST(ForceLog, KeepsWhatADiskThatBecameFullTookAndTheOldFile) {
    const auto file = scratch_file();
    std::ofstream(file) << "old";
    {
        const testing::FileSizeLimit disk(2000);
        ForceLog log(file);
        for (int i = 0; i < 1000; ++i) log.push({});
        log.close();
        EXPECT_THAT(log.error(), AllOf(HasSubstr("File too large"), HasSubstr(part_of(file).string())));
    }
    EXPECT_EQ(text_of(file), "old");
    EXPECT_EQ(text_of(part_of(file)).size(), 2000U);
    std::filesystem::remove(file);
    std::filesystem::remove(part_of(file));
}

TEST(ForceLog, SaysWhereItLiesIfTheFileCannotHaveItsName) {
    const auto file = scratch_file();
    ForceLog log(file);
    log.push({});
    std::filesystem::create_directory(file);
    log.close();
    EXPECT_THAT(log.error(), AllOf(HasSubstr("Is a directory"),
                                   HasSubstr("what there is lies in " + part_of(file).string())));
    EXPECT_THAT(text_of(part_of(file)), StartsWith("t_s,"));
    std::filesystem::remove(file);
    std::filesystem::remove(part_of(file));
}

TEST(ForceLog, KeepsThePartOfASessionThatFailed) {
    const auto file = scratch_file();
    { const ForceLog nothing_written(file); }
    EXPECT_FALSE(std::filesystem::exists(part_of(file)));
    {
        ForceLog log(file);
        log.push({});
        log.drain_all();
    }
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_THAT(text_of(part_of(file)), StartsWith("t_s,"));
    std::filesystem::remove(part_of(file));
}

TEST(ForceLog, DropsLinesRatherThanWaitForADiskThatDoesNotAnswer) {
    const auto pipe = scratch_file();
    std::filesystem::remove(pipe);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::signal(SIGPIPE, SIG_IGN);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // and never reads
    {
        ForceLog log(pipe);
        for (int drain = 0; drain < 10; ++drain) {
            for (std::size_t i = 0; i < ForceLog::capacity / 2; ++i) log.push({});
            log.drain();
        }
        EXPECT_GT(log.dropped(), ForceLog::capacity);
        log.close();
        EXPECT_THAT(log.error(), HasSubstr("the disk does not answer"));
    }
    ::close(reader);
    std::filesystem::remove(pipe);
}

TEST(ForceLog, NamesAFileThatCannotBeCreated) {
    EXPECT_THROW(ForceLog("/nowhere/forces.csv"), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
