// A nerve that a case's segmentation draws beside the bone: the real programs tell how near the burr came.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/recording/playhead.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/folder_test.h"

namespace osteomill::testing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// The nerve: a tube along x, over the block, whose top is z = 2.2.
constexpr double tube_y_mm = 0.5;
constexpr double tube_z_mm = 5.3;
constexpr double tube_radius_mm = 1.2;
constexpr double burr_radius_mm = 1.0;
constexpr double spacing_mm = 0.2;

class StructuresProgram : public FolderTest {
  protected:
    StructuresProgram() {
        write_volume("bone.nrrd", "int16", "", [](double, double, double z_mm) {
            const int hu = z_mm < 2.2 ? 1000 : -1000;
            return std::string{static_cast<char>(hu & 0xFF), static_cast<char>(hu >> 8)};
        });
        write_volume("nerve.seg.nrrd", "uint8",
                     "Segment0_Name:=nerve\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n",
                     [](double, double y_mm, double z_mm) {
                         return std::string(1, from_axis_mm(y_mm, z_mm) <= tube_radius_mm ? '\1' : '\0');
                     });
        write_scene("warn_mm = 0.8");
        // Down beside the nerve into the bone, back, then onto the nerve.
        std::ofstream(file("motion.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                             "0.0,0,-3.2,9,0,0,1,0\n"
                                             "0.2,0,-3.2,9,0,0,1,1\n"
                                             "1.2,0,-3.2,2.6,0,0,1,1\n"
                                             "2.0,0,-3.2,8.5,0,0,1,0\n"
                                             "2.6,0,0.5,8.5,0,0,1,0\n"
                                             "3.4,0,0.5,6.9,0,0,1,0\n"
                                             "4.2,0,0.5,9.5,0,0,1,0\n"
                                             "5.0,0,0.5,13,0,0,1,0\n";
    }
    static double from_axis_mm(double y_mm, double z_mm) {
        return std::hypot(y_mm - tube_y_mm, z_mm - tube_z_mm);
    }
    template <typename Voxel>
    void write_volume(const std::string& name, const std::string& type, const std::string& keys,
                      Voxel&& voxel) const {
        std::ofstream out(file(name), std::ios::binary);
        out << "NRRD0004\ntype: " << type
            << "\ndimension: 3\nspace: left-posterior-superior\nsizes: 48 40 64\n"
               "space directions: (0.2,0,0) (0,0.2,0) (0,0,0.2)\nspace origin: (-4.7,-3.9,-4.1)\n"
               "encoding: raw\nendian: little\n"
            << keys << "\n";
        for (int k = 0; k < 64; ++k)
            for (int j = 0; j < 40; ++j)
                for (int i = 0; i < 48; ++i)
                    out << voxel(-4.7 + spacing_mm * i, -3.9 + spacing_mm * j, -4.1 + spacing_mm * k);
    }
    void write_scene(const std::string& nerve_keys) const {
        std::ofstream(file("scene.toml"))
            << "name = \"tube\"\n[bone]\nfile = \"bone.nrrd\"\nsegmentation = "
               "\"nerve.seg.nrrd\"\nthreshold_hu = 300\n"
               "[[tissues]]\nlabel = 1\nname = \"nerve\"\ncolour = \"#f0d040\"\nsegment = "
               "\"nerve\"\nprotected = true\n"
            << nerve_keys << "\n[[burrs]]\nname = \"2 mm\"\ndiameter_mm = 2.0\nrpm = 40000\n";
    }
    Finished serve(std::vector<std::string> more) const {
        std::vector<std::string> command{HAPTIC_SERVER,      "--clock",          "virtual",
                                         "--scene",          file("scene.toml"), "--trajectory",
                                         file("motion.csv"), "--json",           file("server.json")};
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command);
    }
};

TEST_F(StructuresProgram, LoseAsMuchInEveryTable) {
    // A rod of 2 mm along the bone's surface, half in it, and the plan as well as protected.
    write_volume("nerve.seg.nrrd", "uint8",
                 "Segment0_Name:=nerve\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n",
                 [](double, double y_mm, double z_mm) {
                     return std::string(1, std::hypot(y_mm, z_mm - 2.2) <= 1.0 ? '\1' : '\0');
                 });
    write_scene("warn_mm = 0.8");
    std::ofstream(file("scene.toml"), std::ios::app) << "[plan]\ntissue = \"nerve\"\n";
    std::ofstream(file("motion.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                         "0.0,0.1,0.6,6,0,0,1,0\n0.2,0.1,0.6,6,0,0,1,1\n"
                                         "2.0,0.1,0.6,2.6,0,0,1,1\n3.0,2.0,-0.4,2.6,0,0,1,1\n";
    const Finished served = serve({"--report", file("report")});
    ASSERT_EQ(served.status, 0) << served.err;
    const auto live = nlohmann::json::parse(text("server.json"));
    const double removed_mm3 = live.at("removed_mm3").at("nerve").get<double>();
    EXPECT_GT(removed_mm3, 0.3);
    EXPECT_LT(removed_mm3, live.at("removed_mm3").at("total").get<double>());
    EXPECT_NEAR(live.at("structures").at(0).at("removed_mm3").get<double>(), removed_mm3, 1e-9);
    const auto metrics = nlohmann::json::parse(text("report/metrics.json")).at("metrics");
    EXPECT_NEAR(metrics.at("removed_of_tissue_mm3_of").at("nerve").get<double>(), removed_mm3, 1e-9);
    EXPECT_NEAR(metrics.at("structure_dose_mm3_of").at("nerve").get<double>(), removed_mm3, 1e-9);
    EXPECT_NEAR(metrics.at("plan_removed_mm3").get<double>(), removed_mm3, 1e-9);
    // Half of the rod: within a voxel of the bone's end, the bone is the rod's own.
    EXPECT_NEAR(metrics.at("plan_mm3").get<double>(), 0.5 * 3.14159 * 9.6, 0.05 * 0.5 * 3.14159 * 9.6);
}

TEST_F(StructuresProgram, TellHowFarTheBurrIsFromASoftStructure) {
    const Finished served = serve({"--report", file("report")});
    ASSERT_EQ(served.status, 0) << served.err;
    EXPECT_THAT(served.err, HasSubstr("mm from nerve"));
    EXPECT_THAT(served.err, HasSubstr("the burr touches nerve"));

    // Every state of the recording against the closed form: distance of the axes less the radii.
    Playhead playhead(file("report/session.pcap"));
    ASSERT_EQ(playhead.structures().size(), 1u);
    EXPECT_NEAR(playhead.structures()[0].mask.volume_mm3(), 9.6 * 3.14159 * tube_radius_mm * tube_radius_mm,
                1.5);
    int told = 0, silent = 0;
    double nearest_mm = std::numeric_limits<double>::infinity();
    for (;;) {
        const Playhead::Step step = playhead.step(std::numeric_limits<double>::infinity());
        if (step == Playhead::Step::end) break;
        if (step != Playhead::Step::state) continue;
        const glm::dvec3& at = playhead.tool()->burr_position_mm;
        const double expected_mm = from_axis_mm(at.y, at.z) - tube_radius_mm - burr_radius_mm;
        nearest_mm = std::min(nearest_mm, expected_mm);
        const StructureDistance* now = nearest_structure(playhead.state().distances);
        if (now == nullptr) {
            ++silent;
            EXPECT_GT(expected_mm, 3.0 - 0.5 * spacing_mm);
            continue;
        }
        ++told;
        // Half a voxel for the field, as much for the tube that is made of cubes.
        EXPECT_NEAR(*now->distance_mm, expected_mm, spacing_mm) << at.y << ' ' << at.z;
        EXPECT_EQ(now->touches, *now->distance_mm <= 0.0);
    }
    EXPECT_GT(told, 50);
    EXPECT_GT(silent, 5);
    ASSERT_LT(nearest_mm, -0.2) << "the motion touches it";

    // One and the same: live, in the report and in the recomputed one.
    const auto live = nlohmann::json::parse(text("server.json")).at("structures").at(0);
    const Finished again =
        run_program({PACKET_REPLAY, file("report/session.pcap"), "--report", file("again")});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(text("report/metrics.json"), text("again/metrics.json"));
    const auto metrics = nlohmann::json::parse(text("again/metrics.json")).at("metrics");
    const auto of_nerve = [&](const std::string& key) {
        return metrics.at(key + "_of").at("nerve").get<double>();
    };
    EXPECT_EQ(live.at("name"), "nerve");
    EXPECT_NEAR(live.at("nearest_mm").get<double>(), nearest_mm, spacing_mm);
    EXPECT_EQ(of_nerve("structure_nearest_mm"), 0.0);
    EXPECT_EQ(of_nerve("structure_touches"), 1.0);
    EXPECT_EQ(live.at("touches"), 1);
    EXPECT_EQ(of_nerve("structure_first_touch_s"), live.at("first_touch_s").get<double>());
    EXPECT_NEAR(of_nerve("structure_touched_s"), live.at("touched_s").get<double>(), 1e-9);
    EXPECT_EQ(of_nerve("structure_entered_mm3"), live.at("entered_mm3").get<double>());
    EXPECT_GT(of_nerve("structure_entered_mm3"), 0.0);
    EXPECT_EQ(of_nerve("structure_dose_mm3"), 0.0) << "no bone was in it";

    const Finished csv =
        run_program({PACKET_REPLAY, file("report/session.pcap"), "--states-csv", file("tool.csv")});
    ASSERT_EQ(csv.status, 0) << csv.err;
    EXPECT_THAT(text("tool.csv"), HasSubstr(",nearest_structure,nearest_structure_mm\n"));
    EXPECT_THAT(text("tool.csv"), HasSubstr(",nerve,0."));
}

TEST_F(StructuresProgram, OfACaseThatWasImportedWithItsSegmentationAreGuarded) {
    const auto import = [&](const std::string& folder, const std::string& protect) {
        return run_program({BONE_IMPORT, file("bone.nrrd"), "--case", file(folder), "--threshold-hu", "300",
                            "--segmentation", file("nerve.seg.nrrd"), "--protect", protect, "--warn-mm",
                            "0.8"});
    };
    const Finished imported = import("case", "nerve");
    ASSERT_EQ(imported.status, 0) << imported.err;
    const Finished again = import("case", "nerve");
    EXPECT_NE(again.status, 0) << "a case is never overwritten";
    EXPECT_THAT(again.err, HasSubstr(file("case")));
    const Finished wrong = import("other", "nevre");
    EXPECT_NE(wrong.status, 0);
    EXPECT_THAT(wrong.err, HasSubstr("nevre"));
    EXPECT_FALSE(std::filesystem::exists(file("other")));

    const Finished served =
        run_program({HAPTIC_SERVER, "--clock", "virtual", "--case", file("case"), "--trajectory",
                     file("motion.csv"), "--json", file("case.json"), "--report", file("case_report")});
    ASSERT_EQ(served.status, 0) << served.err;
    EXPECT_THAT(served.err, HasSubstr("the burr touches nerve"));
    const auto structure = nlohmann::json::parse(text("case.json")).at("structures").at(0);
    EXPECT_EQ(structure.at("name"), "nerve");
    EXPECT_EQ(structure.at("touches"), 1);
    EXPECT_LT(structure.at("nearest_mm").get<double>(), -0.2);
    EXPECT_THAT(text("case_report/report.html"), HasSubstr("nerve"));
}

TEST_F(StructuresProgram, OfACaseAreJudgedByTheMarksThatItsImportSet) {
    const auto import = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> command{BONE_IMPORT,      file("bone.nrrd"),     "--case",
                                         file(folder),     "--threshold-hu",      "300",
                                         "--segmentation", file("nerve.seg.nrrd")};
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command);
    };
    const std::vector<std::vector<std::string>> refused{
        {"--pass", "speed=1"},           {"--pass", "time_s"},          {"--pass", "time_s=0"},
        {"--pass", "time_s=nan"},        {"--pass", "time_s=300s"},     {"--pass", "structure_touches=0"},
        {"--pass", "plan_excess_mm3=1"}, {"--pass", "rating_share=0.5"}};
    for (const auto& options : refused) {
        const Finished finished = import("refused", options);
        EXPECT_EQ(finished.status, 2) << options.back();
        EXPECT_THAT(finished.err, AllOf(HasSubstr(options.front()), EndsWith("\n"))) << options.back();
        EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << finished.err;
        EXPECT_FALSE(std::filesystem::exists(file("refused")));
    }

    const Finished imported = import("judged", {"--protect", "nerve", "--pass", "structure_touches=0",
                                                "--pass", "time_s=300", "--description", "Left, 54 years"});
    ASSERT_EQ(imported.status, 0) << imported.err;
    EXPECT_THAT(text("judged/case.toml"), HasSubstr("description = \"Left, 54 years\""));
    const Finished served =
        run_program({HAPTIC_SERVER, "--clock", "virtual", "--case", file("judged"), "--trajectory",
                     file("motion.csv"), "--report", file("judged_report")});
    ASSERT_EQ(served.status, 0) << served.err;
    const auto metrics = nlohmann::json::parse(text("judged_report/metrics.json")).at("metrics");
    EXPECT_EQ(metrics.at("passed"), 0.0) << "the burr touched the nerve";
    EXPECT_THAT(text("judged_report/report.html"), HasSubstr("Not passed"));
}

TEST_F(StructuresProgram, CostNothingWhereNothingIsProtected) {
    write_scene("");
    std::string scene = text("scene.toml");
    scene.replace(scene.find("protected = true"), 16, "protected = false");
    std::ofstream(file("scene.toml")) << scene;
    const Finished served = serve({"--record", file("a.pcap")});
    ASSERT_EQ(served.status, 0) << served.err;
    EXPECT_THAT(served.err, Not(HasSubstr("nerve")));
    EXPECT_FALSE(nlohmann::json::parse(text("server.json")).contains("structures"));
    Playhead playhead(file("a.pcap"));
    EXPECT_TRUE(playhead.structures().empty());
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end) {
        EXPECT_TRUE(playhead.state().distances.empty());
    }
}

}  // namespace
}  // namespace osteomill::testing
