// Files that the programs of 0.3 wrote and that people wrote for them: they open, and mean what they meant
// (docs/compatibility.md). The expected bone follows from make.sh, which made it; the expected session from
// the session.json that it left.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/recording/playhead.h"
#include "common/scene/scene_file.h"
#include "haptic_server/session/session_scene.h"

namespace osteomill {
namespace {

const std::filesystem::path golden = std::filesystem::path(REPOSITORY "/tests/golden") / "0.3";

/// 10 x 10 x 4 mm, full when nothing is milled.
constexpr double block_mm3 = 400.0;

nlohmann::json session_json() {
    return nlohmann::json::parse(std::ifstream(golden / "session.json"));
}

std::string text_of_checksum(std::uint64_t checksum) {
    return fmt::format("{:016x}", checksum);
}

TEST(Golden03, ACaseHasItsBoneAndItsNerve) {
    const SessionScene loaded = load_session_scene(case_chosen((golden / "case").string()));
    EXPECT_EQ(loaded.scene.name, "case");
    EXPECT_NEAR(bone_volume_mm3(loaded.bone), block_mm3, 1e-6);
    EXPECT_EQ(loaded.bone.grid().size_voxels, glm::ivec3(40, 40, 24));
    EXPECT_EQ(loaded.bone.grid().origin_mm, glm::dvec3(-4.875, -4.875, -3.875));
    ASSERT_EQ(loaded.scene.tissues.size(), 1U);
    EXPECT_EQ(loaded.scene.tissues[0].name, "nerve");
    EXPECT_TRUE(loaded.scene.tissues[0].is_protected);
    ASSERT_EQ(loaded.structures.size(), 1U) << "it lies outside the bone, by the segmentation";
}

TEST(Golden03, ASavedBoneIsThatOfItsSessionAndKnowsWhatWasRemoved) {
    const SessionScene loaded = load_session_scene({.bone = golden / "saved.nrrd"});
    const nlohmann::json session = session_json();
    EXPECT_EQ(text_of_checksum(checksum(loaded.bone)), session["bone_checksum"].get<std::string>());
    const double removed_mm3 = session["removed_mm3"]["total"];
    EXPECT_GT(removed_mm3, 0.1);
    const VolumesByTissue& before_mm3 = loaded.source.removed_before_mm3;
    EXPECT_NEAR(std::accumulate(before_mm3.begin(), before_mm3.end(), 0.0), removed_mm3, 1e-6);
    EXPECT_NEAR(bone_volume_mm3(loaded.bone), block_mm3 - removed_mm3, 1e-6);
}

TEST(Golden03, ARecordingIsPlayedToItsBoneTickByTick) {
    Playhead playhead(golden / "recording.pcap");
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end) {
    }
    EXPECT_FALSE(playhead.is_truncated());
    const nlohmann::json session = session_json();
    EXPECT_EQ(text_of_checksum(playhead.bone_checksum()), session["bone_checksum"].get<std::string>());
    EXPECT_EQ(playhead.counts().ticks, session["ticks"]);
    EXPECT_EQ(playhead.counts().missed_ticks, 0U);
    EXPECT_NEAR(playhead.tool()->removed_mm3, session["removed_mm3"]["total"], 1e-9);
    EXPECT_EQ(playhead.session().trainee, "golden");
    EXPECT_EQ(playhead.session().case_name, "case");
    EXPECT_EQ(playhead.session().server_version, "0.3.0");
    EXPECT_EQ(playhead.session().protocol_minor, 1U);
    ASSERT_EQ(playhead.structures().size(), 1U);
}

TEST(Golden03, ASceneOfEveryTableSaysWhatStandsThere) {
    const Scene scene = read_scene(golden / "scene.toml");
    EXPECT_EQ(scene.description, "A block with a lesion and a screw");
    EXPECT_EQ(scene.start_burr, 1U);
    EXPECT_EQ(scene.wall_friction, 0.15);
    EXPECT_EQ(scene.force_scale, 1.5);
    EXPECT_EQ(std::get<FileSource>(scene.bone).path, golden / "saved.nrrd");
    EXPECT_EQ(std::get<FileSource>(scene.bone).threshold_hu, 250.0);
    EXPECT_EQ(scene.stiffness.knots.size(), 2U);
    ASSERT_EQ(scene.tissues.size(), 4U);
    EXPECT_EQ(scene.tissues[0].opacity, 0.5);
    EXPECT_EQ(scene.tissues[1].warn_mm, 2.5);
    EXPECT_FALSE(scene.tissues[2].is_cuttable);
    EXPECT_EQ(scene.burrs[0].cutting_coefficients_n_per_mm2, glm::dvec3(100.0, 20.0, 10.0));
    EXPECT_EQ(scene.burrs[0].edge_coefficients_n_per_mm, glm::dvec3(0.5, 0.25, 0.0));
    EXPECT_DOUBLE_EQ(scene.burrs[0].spindle_rev_per_s, 1000.0);
    EXPECT_EQ(scene.burrs[0].sense, SpindleSense::counter_clockwise);
    EXPECT_EQ(scene.burrs[0].shank, (ShankProfile{{1.2, 0.4}, {10.0, 0.5}}));
    EXPECT_EQ(scene.burrs[1].head.shape, HeadShape::pear);
    EXPECT_EQ(scene.burrs[1].head.neck_diameter_mm, 1.0);
    EXPECT_EQ(scene.motor, (Motor{.stall_torque_n_mm = 3.0, .steady_torque_n_mm = 1.0}));
    EXPECT_EQ(scene.device.rotation * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(scene.start_pose.spindle_axis, glm::dvec3(0.0, 0.6, 0.8));
    EXPECT_EQ(scene.trajectory.width_mm, 5.0);
    EXPECT_EQ(scene.plan, (Plan{.region = CylinderRegion{{0, 0, 0}, {0, 0, 5}, 2.0}, .margin_mm = 0.25}));
    EXPECT_EQ(scene.pass.at("peak_force_n"), 4.0);
    EXPECT_EQ(scene.pass.size(), 5U);
}

}  // namespace
}  // namespace osteomill
