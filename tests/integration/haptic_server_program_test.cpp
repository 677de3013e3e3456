// The server as its users start it: its output, its files, its exit status.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "tests/support/folder_test.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr bool is_optimised = IS_OPTIMISED;

struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;
};

class HapticServerProgram : public FolderTest {
  protected:
    Outcome run(const std::string& arguments) const {
        const std::string command =
            HAPTIC_SERVER " " + arguments + " >" + file("out") + " 2>" + file("err") + " </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("out"), text("err")};
    }
};

TEST_F(HapticServerProgram, MillsOnTheVirtualClockAndWritesWhatItMeasured) {
    const Outcome outcome =
        run("--clock virtual --duration-s 3 --json " + file("a.json") + " --log-csv " + file("forces.csv"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json measured = json("a.json");
    EXPECT_EQ(measured.at("ticks"), 3001);
    EXPECT_EQ(measured.at("missed_deadlines"), 0);
    for (const char* key : {"p50", "p99", "p999", "max"}) {
        EXPECT_TRUE(measured.at("wakeup_latency_us").contains(key));
        EXPECT_GT(measured.at("milling_step_us").at(key).get<double>(), 0.0);
    }
    EXPECT_GT(measured.at("removed_mm3").at("total").get<double>(), 0.0);
    EXPECT_TRUE(measured.at("removed_mm3").contains("carious lesion"));
    EXPECT_GT(measured.at("peak_force_n").get<double>(), 0.0);
    EXPECT_EQ(measured.at("bone_checksum").get<std::string>().size(), 16u);

    std::istringstream lines(text("forces.csv"));
    long count = 0;
    for (std::string line; std::getline(lines, line);) ++count;
    EXPECT_EQ(count, 1 + 3001);
}

TEST_F(HapticServerProgram, SaysInOneLineWhyItMeasuresNoArm) {
    const std::string into = " --save-profile " + file("nowhere") + "/arm.toml";
    for (const auto& [arguments, why] :
         {std::pair<std::string, std::string>{"--device client", "is no arm"},
          {"--json " + file("a.json"), "which runs no session"},
          {"--clock virtual" + into, "there is no folder"},
          {"--device hid --save-profile " + file("arm.toml"), "is it plugged in and powered?"}}) {
        const Outcome outcome = run("--measure-arm " + arguments);
        EXPECT_GT(outcome.exit_code, 0) << arguments;
        EXPECT_THAT(outcome.err, HasSubstr(why));
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(file("arm.toml")));
    }
}

TEST_F(HapticServerProgram, FeelsAShankAndIsRepeatable) {
    // A burr on its side cuts its way along the top of the cube, its shank over the bone that is still to
    // come.
    std::ofstream(file("motion.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,-20,0,4,1,0,0,"
                                         "0\n0.5,-20,0,2.2,1,0,0,1\n3,-10,0,2.2,1,0,0,1\n";
    std::ofstream(file("shank.toml")) << R"(name = "shank"
[bone]
phantom = "cube"
[[burrs]]
name = "5 mm"
diameter_mm = 5.0
shank = [[3.0, 2.4], [40.0, 2.4]]
[start_pose]
position_mm = [-20.0, 0.0, 4.0]
spindle_axis = [1.0, 0.0, 0.0]
[trajectory]
file = "motion.csv"
)";
    for (const std::string name : {"a", "b"}) {
        const Outcome outcome =
            run("--scene " + file("shank.toml") + " --clock virtual --duration-s 3 --json " +
                file(name + ".json") + " --log-csv " + file(name + ".csv"));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    EXPECT_EQ(text("a.csv"), text("b.csv"));
    EXPECT_EQ(json("a.json").at("bone_checksum"), json("b.json").at("bone_checksum"));
    std::istringstream lines(text("a.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr(",fault,shank_torque_x_n_mm"));
    bool has_torque = false;
    while (std::getline(lines, line)) has_torque |= !line.ends_with(",0.0000,0.0000,0.0000");
    EXPECT_TRUE(has_torque);
}

TEST_F(HapticServerProgram, TakesUpACarvedBoneWhereItWasLeft) {
    const Outcome first = run("--scene tooth --clock virtual --duration-s 3 --save-bone " +
                              file("carved.nrrd") + " --json " + file("a.json"));
    ASSERT_EQ(first.exit_code, 0) << first.err;
    std::ofstream(file("rest.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0,0,20,0,0,1,0\n";
    EXPECT_FALSE(json("a.json").contains("removed_before_mm3"));
    const double first_mm3 = json("a.json").at("removed_mm3").at("total");
    // And once more, from the file that was saved over.
    for (int generation = 0; generation < 2; ++generation) {
        const Outcome second = run("--bone " + file("carved.nrrd") + " --trajectory " + file("rest.csv") +
                                   " --clock virtual --duration-s 0.1 --save-bone " + file("carved.nrrd") +
                                   " --json " + file("b.json"));
        ASSERT_EQ(second.exit_code, 0) << second.err;
        EXPECT_THAT(second.err, HasSubstr("mm^3 were removed before; the count goes on from there"));
        EXPECT_EQ(json("b.json").at("bone_checksum"), json("a.json").at("bone_checksum"));
        EXPECT_NEAR(json("b.json").at("removed_mm3").at("total"), first_mm3, 1e-6);
        EXPECT_EQ(json("b.json").at("removed_before_mm3"), json("b.json").at("removed_mm3"));
    }
}

TEST_F(HapticServerProgram, DrillsTheCariesOutOfTheJawAndLeavesThePulpClosed) {
    if (!is_optimised) GTEST_SKIP() << "half a minute of drilling takes its time unless optimised";
    const Outcome outcome = run("--case jaw --clock virtual --duration-s 40 --json " + file("a.json") +
                                " --report " + file("report"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json removed = json("a.json").at("removed_mm3");
    EXPECT_EQ(removed.at("pulp"), 0.0);
    EXPECT_EQ(removed.at("nerve canal"), 0.0);
    EXPECT_EQ(removed.at("gum"), 0.0);
    const nlohmann::json metrics = json("report/metrics.json").at("metrics");
    EXPECT_GT(metrics.at("plan_removed_share").get<double>(), 0.8);
    EXPECT_LT(metrics.at("plan_excess_mm3").get<double>(), 0.5) << "sound tissue beyond the margin of 0.5 mm";
}

TEST_F(HapticServerProgram, MillsAHeadInMemoryThatFollowsItsBone) {
    if (!is_optimised) GTEST_SKIP() << "the head takes its time unless optimised";
    constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
    const std::string session = "--scene head --clock virtual --duration-s 4 --json ";
    const Outcome alone = run(session + file("alone.json"));
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const nlohmann::json bone = json("alone.json").at("bone");
    EXPECT_NEAR(bone.at("bone_mm3").get<double>(), 0.02 * 204.8 * 204.8 * 204.8, 5000.0);
    EXPECT_LT(bone.at("peak_resident_bytes").get<double>(), 1.3 * bone.at("memory_bytes").get<double>())
        << "nothing is copied while it is built";
    EXPECT_GT(json("alone.json").at("removed_mm3").at("total").get<double>(), 0.1);

    const Outcome shown = run(session + file("shown.json") + " --listen 127.0.0.1:0");
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_LT(json("shown.json").at("bone").at("peak_resident_bytes").get<double>(), gibibyte)
        << "with the copy for clients";
    EXPECT_EQ(json("shown.json").at("bone_checksum"), json("alone.json").at("bone_checksum"));
}

TEST_F(HapticServerProgram, EndsWithTheTrajectory) {
    std::ofstream(file("short.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                        "0,0,0,20,0,0,1,0\n0.4,1,0,20,0,0,1,0\n";
    ASSERT_EQ(
        run("--clock virtual --trajectory " + file("short.csv") + " --json " + file("a.json")).exit_code, 0);
    EXPECT_NEAR(json("a.json").at("duration_s").get<double>(), 0.4, 0.1);
}

TEST_F(HapticServerProgram, ReturnsTwoForWrongUsageAndOneForAFailureWithOneLine) {
    const auto expect_one_line = [](const std::string& text) {
        EXPECT_THAT(text, StartsWith("haptic_server: "));
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    };
    const Outcome usage = run("--coupling magic");
    EXPECT_EQ(usage.exit_code, 2);
    expect_one_line(usage.err);

    const Outcome no_scene = run("--scene /nowhere/scene.toml");
    EXPECT_EQ(no_scene.exit_code, 1);
    expect_one_line(no_scene.err);
    EXPECT_THAT(no_scene.err, HasSubstr("/nowhere/scene.toml"));

    const Outcome no_folder = run("--clock virtual --duration-s 1 --json /nowhere/a.json");
    EXPECT_EQ(no_folder.exit_code, 1);
    expect_one_line(no_folder.err);

    std::ofstream(file("endless.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0,0,20,0,0,1,0\n";
    const Outcome for_ever = run("--clock virtual --trajectory " + file("endless.csv"));
    EXPECT_EQ(for_ever.exit_code, 1);
    EXPECT_THAT(for_ever.err, HasSubstr("--duration-s"));
}

TEST_F(HapticServerProgram, ReportsAFullDiskInOneLineAndStillWritesTheRest) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const Outcome outcome =
        run("--clock virtual --duration-s 1 --log-csv /dev/full --json " + file("a.json"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("haptic_server: /dev/full: "));
    EXPECT_EQ(json("a.json").at("ticks"), 1001);
}

}  // namespace
}  // namespace osteomill::testing
