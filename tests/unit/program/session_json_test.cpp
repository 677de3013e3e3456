#include "haptic_server/program/session_json.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace osteomill {
namespace {

std::unique_ptr<MillingSessionReport> some_report() {
    auto report = std::make_unique<MillingSessionReport>();
    report->haptic.ticks = 1000;
    report->haptic.missed = 3;
    report->haptic.late = 4;
    for (int i = 1; i <= 100; ++i) report->haptic.wakeup_latency.add(1e-6 * i);
    report->milling.duration.add(250e-6);
    report->removed_mm3[0] = 0.25;
    report->removed_mm3[3] = 1.5;
    report->peak_force_n = 2.5;
    report->fault_counts[static_cast<std::size_t>(Fault::overrun)] = 2;
    report->bone_checksum = 0x00ab00000000cdefULL;
    return report;
}

Scene labelled_scene() {
    Scene scene;
    scene.name = "test";
    scene.tissues = {{3, "dentine", {}, false}, {4, "enamel", {}, false}};
    return scene;
}

TEST(SessionJson, HaveTheKeysThatAreFixed) {
    const auto json = session_json(*some_report(), {}, 0, labelled_scene(), {});
    EXPECT_EQ(json.at("ticks"), 1000);
    EXPECT_EQ(json.at("missed_deadlines"), 3);
    EXPECT_NEAR(json.at("wakeup_latency_us").at("p50").get<double>(), 50.0, 2.0);
    EXPECT_NEAR(json.at("wakeup_latency_us").at("p99").get<double>(), 99.0, 3.0);
    EXPECT_NEAR(json.at("wakeup_latency_us").at("p999").get<double>(), 100.0, 1e-6);
    EXPECT_NEAR(json.at("wakeup_latency_us").at("max").get<double>(), 100.0, 1e-6);
    EXPECT_NEAR(json.at("milling_step_us").at("max").get<double>(), 250.0, 1e-6);
    EXPECT_EQ(json.at("peak_force_n"), 2.5);
    EXPECT_EQ(json.at("bone_checksum"), "00ab00000000cdef");
    EXPECT_EQ(json.at("faults").at("overrun"), 2);
    EXPECT_EQ(json.at("late_ticks"), 4);
    const auto steps = histograms_us(*some_report()).at("milling_step");
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_NEAR(steps.at(0).at(0).get<double>(), 250.0, 1e-6);
    EXPECT_EQ(steps.at(0).at(1), 1);
}

TEST(SessionJson, NameEveryTissueOfTheSceneAndWhatHasNoLabel) {
    const auto removed = session_json(*some_report(), {}, 0, labelled_scene(), {}).at("removed_mm3");
    EXPECT_EQ(removed.at("total"), 1.75);
    EXPECT_EQ(removed.at("dentine"), 1.5);
    EXPECT_EQ(removed.at("enamel"), 0.0);
    EXPECT_EQ(removed.at("unlabelled"), 0.25);
}

TEST(SessionJson, NameNoTissueWhereTheSceneHasNone) {
    const auto removed = session_json(*some_report(), {}, 0, Scene{}, {}).at("removed_mm3");
    EXPECT_EQ(removed.size(), 1u);
}

TEST(SessionJson, SayWhatTheBoneCost) {
    const BoneCost cost{.memory_bytes = 3000, .bone_mm3 = 1.5, .startup_s = 0.25};
    const auto bone = session_json(*some_report(), cost, 4096, Scene{}, {}).at("bone");
    EXPECT_EQ(bone.at("memory_bytes"), 3000);
    EXPECT_EQ(bone.at("bone_mm3"), 1.5);
    EXPECT_EQ(bone.at("bytes_per_mm3"), 2000.0);
    EXPECT_EQ(bone.at("startup_s"), 0.25);
    EXPECT_EQ(bone.at("peak_resident_bytes"), 4096);
}

TEST(SessionJson, SayNoBytesPerVolumeWhereThereIsNoBone) {
    const auto bone = session_json(*some_report(), {}, 4096, Scene{}, {}).at("bone");
    EXPECT_FALSE(bone.contains("bytes_per_mm3"));
}

TEST(SessionJson, SayWhichFileCannotBeWritten) {
    try {
        write_json({{"ticks", 1}}, "/nowhere/out.json");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).rfind("/nowhere/out.json: ", 0), 0u) << error.what();
    }
}

TEST(PeakResidentBytes, AreReadFromTheSystemsText) {
    std::istringstream status(
        "Name:\thaptic server\nVmPeak:\t  999999 kB\nVmHWM:\t    1234 kB\nVmRSS:\t 99 kB\n");
    EXPECT_EQ(peak_resident_bytes(status), 1234U * 1024U);
}

TEST(PeakResidentBytes, AreUnknownWhereTheTextLacksThem) {
    std::istringstream status("Name:\tVmHWM: 5 kB\nVmHWM:\tmany kB\n");
    EXPECT_EQ(peak_resident_bytes(status), std::nullopt);
}

TEST(PeakResidentBytes, OfThisProgramAreAtLeastWhatItUses) {
    std::ifstream status("/proc/self/status");
    const std::vector<char> used(std::size_t{8} << 20U, 'x');
    EXPECT_GE(peak_resident_bytes(status).value_or(0), used.size());
}

}  // namespace
}  // namespace osteomill
