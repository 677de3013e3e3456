// haptic_server drives an arm through hidapi, hidraw and the kernel, in a virtual machine: it is calibrated,
// mills as the simulated arm does, and survives nonsense and a pulled cable.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/force_log_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

/// Why there can be no virtual machine here; empty if there can.
std::string obstacle() {
    for (const char* program : {"qemu-system-x86_64", "busybox", "cpio"}) {
        const auto found = testing::run_program({"/bin/sh", "-c", std::string("command -v ") + program});
        if (found.status != 0) return std::string(program) + " is not installed";
    }
    if (!std::filesystem::exists(std::filesystem::path(REPOSITORY "/build/vm-kernel") / "vmlinuz"))
        return "there is no kernel: scripts/fetch_vm_kernel.sh brings one";
    return "";
}

using Tick = testing::ForceLogLine;

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The ticks from when the spindle starts on, for `duration_s`, their times from there.
std::vector<Tick> milling_of(const std::vector<Tick>& log, double duration_s) {
    const auto begins =
        std::find_if(log.begin(), log.end(), [](const Tick& tick) { return tick.spindle_on; });
    std::vector<Tick> part;
    for (auto tick = begins; tick != log.end() && tick->time_s - begins->time_s <= duration_s; ++tick) {
        part.push_back(*tick);
        part.back().time_s -= begins->time_s;
    }
    return part;
}

/// At a time from the first tick on.
const Tick& at(const std::vector<Tick>& ticks, double time_s) {
    const auto next =
        std::lower_bound(ticks.begin(), ticks.end(), time_s,
                         [](const Tick& tick, double wanted_s) { return tick.time_s < wanted_s; });
    return next == ticks.end() ? ticks.back() : *next;
}

/// Distance between two paths at the same times. The time at which friction holds a hand or lets go of it
/// varies, so the largest distance describes a moment only.
double rms_distance_mm(const std::vector<Tick>& path, const std::vector<Tick>& other) {
    double sum_mm2 = 0.0;
    for (const Tick& tick : path) {
        const glm::dvec3 apart_mm = tick.burr_mm - at(other, tick.time_s).burr_mm;
        sum_mm2 += glm::dot(apart_mm, apart_mm);
    }
    return std::sqrt(sum_mm2 / static_cast<double>(path.size()));
}

double mean_force_n(const std::vector<Tick>& ticks, double from_s, double to_s) {
    double sum_n = 0.0;
    int count = 0;
    for (const Tick& tick : ticks) {
        if (tick.time_s < from_s || tick.time_s > to_s) continue;
        sum_n += glm::length(tick.force_n);
        ++count;
    }
    return sum_n / count;
}

/// 9 x 5 x 4 mm of bone at 1600 HU, its top at z = 0.
void write_block(const std::filesystem::path& file) {
    HuVolume volume;
    volume.grid = {.size_voxels = {90, 50, 40}, .spacing_mm = 0.1, .origin_mm = {-4.45, -2.45, -3.95}};
    volume.hu.assign(std::size_t{90} * 50 * 40, 1600);
    testing::write_bone_file(file, volume, {{threshold_key, "300"}});
}

/// The faults that follow one another in a log, each once.
std::vector<int> faults_of(const std::vector<Tick>& log) {
    std::vector<int> faults;
    for (const Tick& tick : log)
        if (faults.empty() || faults.back() != tick.fault) faults.push_back(tick.fault);
    return faults;
}

/// When the spindle has turned for the last time.
double last_milling_s(const std::vector<Tick>& log) {
    const auto last =
        std::find_if(log.rbegin(), log.rend(), [](const Tick& tick) { return tick.spindle_on; });
    return last == log.rend() ? 0.0 : last->time_s;
}

TEST(HidArmInAVirtualMachine, MillsAsTheSimulatedOneAndSurvivesNonsenseAndAPulledCable) {
    if (const std::string reason = obstacle(); !reason.empty()) GTEST_SKIP() << reason;
    const testing::TemporaryFolder folder;
    for (const char* file : {"run.sh", "scene.toml", "trajectory.csv", "vm_arm.toml"})
        std::filesystem::copy(std::filesystem::path(REPOSITORY "/tests/vm") / file, folder / file);
    write_block(folder / "block.nrrd");

    const auto host =
        testing::run_program({HAPTIC_SERVER, "--scene", folder / "scene.toml", "--trajectory",
                              folder / "trajectory.csv", "--clock", "virtual", "--milling-rate-hz", "250",
                              "--duration-s", "5", "--log-csv", folder / "simulated.csv"});
    ASSERT_EQ(host.status, 0) << host.err;
    const auto machine =
        testing::run_program({REPOSITORY "/tests/vm/run_in_vm.sh", REPOSITORY "/build/vm-kernel",
                              folder.path(), HAPTIC_SERVER, UHID_ARM},
                             std::chrono::seconds(270));
    ASSERT_EQ(machine.status, 0) << machine.err << text_of(folder / "console");
    const std::filesystem::path out = folder / "out";
    const std::string said = text_of(out / "server.txt");
    const std::string arm_said = text_of(out / "arm.txt");
    ASSERT_EQ(text_of(out / "exit_code"), "0\n") << said << arm_said;

    EXPECT_THAT(text_of(out / "devices.txt"), HasSubstr("1234:0006 Virtual arm"));
    EXPECT_THAT(text_of(out / "devices.txt"), HasSubstr("/dev/hidraw0: ready"));
    EXPECT_THAT(said, HasSubstr("press the calibration switch"));
    EXPECT_THAT(arm_said, HasSubstr("followed the trajectory to its end"));

    // Path, force and bone removed are those of the same motion on the simulated arm.
    constexpr double two_encoder_steps_mm = 0.11;
    const std::vector<Tick> log = testing::read_force_log(out / "server.csv");
    const std::vector<Tick> real = milling_of(log, 2.6);
    const std::vector<Tick> simulated = milling_of(testing::read_force_log(folder / "simulated.csv"), 2.6);
    const double apart_mm = rms_distance_mm(simulated, real);
    const double real_n = mean_force_n(real, 1.0, 2.2);
    const double simulated_n = mean_force_n(simulated, 1.0, 2.2);
    std::printf(
        "paths %.3f mm apart in the rms, mean force %.3f N against %.3f N, removed %.3f mm^3 against %.3f\n",
        apart_mm, real_n, simulated_n, real.back().removed_mm3, simulated.back().removed_mm3);
    EXPECT_LT(apart_mm, two_encoder_steps_mm);
    EXPECT_GT(simulated_n, 0.05);
    EXPECT_NEAR(real_n, simulated_n, 0.15 * simulated_n);
    EXPECT_NEAR(real.back().removed_mm3, simulated.back().removed_mm3, 0.08 * simulated.back().removed_mm3);

    // Lost until calibrated, at the nonsense, and while unplugged; each time the force comes back.
    constexpr int none = 0;
    constexpr int device_lost = 1;
    // After the nonsense the burr is back inside the bone, and is lifted out.
    constexpr int in_bone = 6;
    EXPECT_EQ(faults_of(log),
              (std::vector<int>{device_lost, none, device_lost, in_bone, none, device_lost, none}))
        << said;
    EXPECT_THAT(said, HasSubstr("the burr is inside the bone"));
    EXPECT_THAT(said, HasSubstr("plug it in again"));
    double lost_since_s = -1.0;
    for (const Tick& tick : log) {
        if (tick.fault == none) lost_since_s = -1.0;
        if (tick.fault != none && lost_since_s < 0.0) lost_since_s = tick.time_s;
        if (tick.fault != none && tick.time_s - lost_since_s > 0.05) {
            ASSERT_EQ(glm::length(tick.force_n), 0.0) << tick.time_s;
        }
    }
    // With the spindle off a force pushes out of the bone, whose top is z = 0, or along it; none pulls
    // deeper.
    constexpr double friction_of_a_turn_n = 0.1;
    const double pressing_from_s = last_milling_s(log);
    for (const Tick& tick : log) {
        if (tick.time_s <= pressing_from_s) continue;
        ASSERT_GT(tick.force_n.z, -friction_of_a_turn_n) << "pulled deeper at " << tick.time_s << " s";
    }
    // Until the session ends and the force fades.
    EXPECT_GT(mean_force_n(log, log.back().time_s - 0.3, log.back().time_s - 0.1), 0.1)
        << "the wall is felt again, in the end";

    // The motors' work, as the arm saw it: they pushed, and had no current while the cable was out.
    double strongest_n = 0.0;
    for (const auto& c : testing::read_csv_numbers(out / "arm.csv")) {
        const double force_n = glm::length(glm::dvec3(c.at(4), c.at(5), c.at(6)));
        strongest_n = std::max(strongest_n, force_n);
    }
    EXPECT_GT(strongest_n, 0.3);
    EXPECT_LT(strongest_n, 3.4);
}

TEST(HidArmInAVirtualMachine, MillsUnderTheServiceWithAllThatItsUnitTakesAway) {
    if (const std::string reason = obstacle(); !reason.empty()) GTEST_SKIP() << reason;
    const std::string systemd = "/lib/systemd/systemd";
    if (!std::filesystem::exists(systemd)) GTEST_SKIP() << "systemd is not installed";
    const testing::TemporaryFolder folder;
    for (const char* file : {"scene.toml", "trajectory.csv", "vm_arm.toml"})
        std::filesystem::copy(std::filesystem::path(REPOSITORY "/tests/vm") / file, folder / file);
    std::filesystem::copy(std::filesystem::path(REPOSITORY "/tests/vm") / "run_service.sh",
                          folder / "run.sh");
    std::filesystem::copy(REPOSITORY "/scripts/systemd/osteomill.service", folder / "osteomill.service");
    write_block(folder / "block.nrrd");
    std::vector<std::string> command{REPOSITORY "/tests/vm/run_in_vm.sh",
                                     REPOSITORY "/build/vm-kernel",
                                     folder.path(),
                                     HAPTIC_SERVER,
                                     UHID_ARM,
                                     systemd};
    // Since version 255 it starts services by a program of its own.
    if (const std::string executor = "/lib/systemd/systemd-executor"; std::filesystem::exists(executor))
        command.push_back(executor);
    const auto machine = testing::run_program(command, std::chrono::seconds(270));
    ASSERT_EQ(machine.status, 0) << machine.err << text_of(folder / "console");
    const std::filesystem::path out = folder / "out";
    const std::string said = text_of(out / "server.txt") + text_of(folder / "console");
    ASSERT_EQ(text_of(out / "result.txt"), "success 0\n") << said;
    std::ifstream report(out / "server.json");
    const auto json = nlohmann::json::parse(report);
    EXPECT_GT(json.at("removed_mm3").at("total"), 0.0) << "the arm was calibrated and milled\n" << said;
    EXPECT_TRUE(json.at("real_time_priority"));
    EXPECT_TRUE(json.at("memory_locked"));
    // Written as osteomill, for osteomill alone.
    EXPECT_THAT(text_of(out / "state.txt"), HasSubstr("-rw------- "));
    EXPECT_THAT(text_of(out / "state.txt"), ::testing::ContainsRegex(" 900 +900 "));
}

}  // namespace
}  // namespace osteomill
