#include "imaging/case/case_folder.h"

#include <gmock/gmock.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "common/scene/scene_file.h"
#include "imaging/case/bone_source.h"
#include "imaging/case/case_placement.h"
#include "imaging/formats/picture_file.h"
#include "imaging/import_bone.h"
#include "imaging/segmentation/bone_of_labels.h"
#include "imaging/segmentation/segmentation_file.h"
#include "tests/support/block_file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The grid of testing::write_block, with an empty margin of 2 mm around it.
const Grid around_block{.size_voxels = {68, 60, 52}, .spacing_mm = 0.2, .origin_mm = {-6.7, -5.9, -6.1}};

StructureMask ball(const glm::dvec3& centre_mm, double radius_mm) {
    std::map<BrickIndex, VoxelMask> bricks;
    glm::ivec3 v;
    for (v.z = 0; v.z < around_block.size_voxels.z; ++v.z)
        for (v.y = 0; v.y < around_block.size_voxels.y; ++v.y)
            for (v.x = 0; v.x < around_block.size_voxels.x; ++v.x)
                if (glm::distance(centre_of_voxel_mm(around_block, v), centre_mm) < radius_mm)
                    bricks[brick_index(size_in_bricks(around_block), v / brick_edge_voxels)].set(
                        offset_in_brick(v % brick_edge_voxels));
    std::vector<StructureBrick> all;
    for (const auto& [brick, voxels] : bricks) all.push_back({brick, voxels});
    return {around_block, std::move(all)};
}

class CaseFolder : public ::testing::Test {
  protected:
    CaseFolder() {
        write_segmentation(segmentation, {{"target", {0, 200, 0}, ball({0.0, 0.0, 0.0}, 1.5)},
                                          {"nerve", {250, 220, 30}, ball({0.0, 0.0, -2.5}, 1.0)},
                                          {"flap", {200, 200, 200}, ball({0.0, 0.0, 0.0}, 2.0)},
                                          {"air", {1, 2, 3}, ball({0.0, -5.5, -5.5}, 0.3)}});
    }
    /// The messages of making the case, or its error.
    std::string made(const CaseParts& parts) {
        std::ostringstream messages;
        try {
            const BegunCase known = read_case_parts(parts);
            begin_case(folder);
            testing::write_block(bone_of_case(folder));
            finish_case(folder, known, messages);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return messages.str();
    }
    Scene scene() const { return read_scene(folder / "case.toml"); }

    testing::TemporaryFolder where;
    std::filesystem::path folder = where / "my case";
    std::filesystem::path segmentation = where / "s.seg.nrrd";
};

TEST_F(CaseFolder, HoldsASceneThatLoadsByItself) {
    const std::string messages = made(
        {.segmentations = {segmentation}, .is_protected = {"nerve"}, .warn_mm = 2.5, .target = "target"});
    EXPECT_THAT(messages, HasSubstr("segment \"air\" lies outside the bone; left out"));
    std::filesystem::remove(segmentation);
    const Scene read = scene();
    EXPECT_EQ(read.name, "my case");
    ASSERT_EQ(read.tissues.size(), 3U);
    EXPECT_EQ(read.tissues[1].name, "nerve");
    EXPECT_TRUE(read.tissues[1].is_protected);
    EXPECT_EQ(read.tissues[1].warn_mm, 2.5);
    EXPECT_EQ(read.tissues[1].shows_through_mm, usual_shows_through_mm(true)) << "thin bone shows it";
    EXPECT_EQ(read.tissues[0].shows_through_mm, 0.0);
    EXPECT_FALSE(read.tissues[0].is_protected);
    ASSERT_TRUE(read.plan);
    EXPECT_EQ(std::get<TissueRegion>(read.plan->region).tissue, "target");
    const LoadedBone loaded = load_bone(read);
    ASSERT_EQ(loaded.structures.size(), 1U);
    const double ball_mm3 = 4.0 / 3.0 * std::numbers::pi;
    EXPECT_NEAR(loaded.structures[0].mask.volume_mm3(), ball_mm3, 0.05 * ball_mm3);
    // The flap is the later of the two, but the planned tissue takes precedence.
    const double target_mm3 = loaded.source.loaded_mm3.at(read.tissues[0].label);
    EXPECT_NEAR(target_mm3, 1.5 * 1.5 * 1.5 * ball_mm3, 0.1 * target_mm3);
}

TEST_F(CaseFolder, OfAScanAloneHasNoTissues) {
    EXPECT_EQ(made({}), "");
    EXPECT_TRUE(scene().tissues.empty());
    EXPECT_FALSE(std::filesystem::exists(folder / "segmentation.seg.nrrd"));
    EXPECT_FALSE(load_bone(scene()).bone.content().brick_of_slot.empty());
}

TEST_F(CaseFolder, HasASentenceAndAPictureForItsCard) {
    made({.segmentations = {segmentation}, .target = "target"});
    EXPECT_EQ(scene().description, "10 x 8 x 6 mm in voxels of 0.2 mm; to be removed: target.");
    const SlicePicture picture = read_png_slice(folder / "picture.png");
    EXPECT_EQ(picture.width, 240);
    EXPECT_EQ(picture.height, 160);
    const auto grey = [&](int x, int y) {
        return picture.values[static_cast<std::size_t>(y) * 240 + static_cast<std::size_t>(x)];
    };
    EXPECT_NE(grey(120, 80), grey(2, 80)) << "bone before a background";
    EXPECT_NE(grey(2, 2), grey(2, 157)) << "which is not white";
}

TEST_F(CaseFolder, WarnsOfEachStructureFromItsOwnDistance) {
    made({.segmentations = {segmentation},
          .is_protected = {"nerve", "flap"},
          .warn_mm = 2.5,
          .warns_from_mm = {{"nerve", 0.5}}});
    EXPECT_EQ(scene().tissues[1].warn_mm, 0.5);
    EXPECT_EQ(scene().tissues[2].warn_mm, 2.5);
}

TEST_F(CaseFolder, IsNeverOverwritten) {
    made({});
    EXPECT_THAT(made({}), HasSubstr("my case: holds a case already"));
}

TEST_F(CaseFolder, IsRefusedBeforeTheWorkWhereANameIsNone) {
    EXPECT_THAT(made({.segmentations = {segmentation}, .is_protected = {"nerv"}}),
                HasSubstr("--protect: no segment is called \"nerv\"; did you mean \"nerve\"?"));
    EXPECT_THAT(
        made({.segmentations = {segmentation}, .target = "something else"}),
        HasSubstr("--target: no segment is called \"something else\"; there are air, flap, nerve, target"));
    EXPECT_THAT(made({.segmentations = {segmentation, segmentation}}),
                HasSubstr("as one before has; rename it"));
    EXPECT_THAT(made({.segmentations = {where / "nowhere.nrrd"}}), HasSubstr("nowhere.nrrd"));
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(CaseFolder, GuardsNothingThatIsNotThere) {
    EXPECT_THAT(made({.segmentations = {segmentation}, .is_protected = {"air"}}),
                HasSubstr("--protect: no voxel of the bone's box is in \"air\": it would guard nothing"));
    EXPECT_FALSE(std::filesystem::exists(folder / "case.toml"));
}

TEST_F(CaseFolder, SaysWhatThePlanCannotRemove) {
    EXPECT_THAT(made({.segmentations = {segmentation}, .is_protected = {"flap"}, .target = "target"}),
                HasSubstr("no voxel of the bone is of the plan's tissue \"target\""));
}

TEST_F(CaseFolder, TakesLabelMapsWithNamesAndColours) {
    const std::filesystem::path map = where / "map.nrrd";
    {
        std::ofstream out(map, std::ios::binary);
        out << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
               "space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (-3,-3,-3)\nencoding: raw\n\n";
        for (int i = 0; i < 64; ++i) out.put(i / 16 < 2 ? '\1' : '\5');
    }
    const std::filesystem::path colours = where / "names.ctbl";
    std::ofstream(colours) << "1 lower_half 10 20 30 255\n5 upper_half 40 50 60 255\n9 unused 0 0 0 0\n";
    made({.segmentations = {map, segmentation}, .colours = colours, .is_protected = {"lower_half"}});
    const Scene read = scene();
    ASSERT_EQ(read.tissues.size(), 5U);
    EXPECT_EQ(read.tissues[0].name, "lower half");
    EXPECT_EQ(read.tissues[0].colour_rgb, (std::array<std::uint8_t, 3>{10, 20, 30}));
    EXPECT_TRUE(read.tissues[0].is_protected);
    EXPECT_EQ(load_bone(read).structures.size(), 1U);
}

/// A jaw without a CT, 0.5 mm: a ball of enamel in one of bone, a rod of nerve beside them.
void write_jaw_labels(const std::filesystem::path& path) {
    std::ofstream out(path, std::ios::binary);
    out << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 40 40 40\n"
           "space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nspace origin: (-9.75,-9.75,-9.75)\nencoding: "
           "raw\n"
           "Segment0_Name:=Mandible\nSegment0_LabelValue:=1\nSegment1_Name:=thing\nSegment1_LabelValue:=2\n"
           "Segment2_Name:=Mandibular canal\nSegment2_LabelValue:=3\n\n";
    for (int z = 0; z < 40; ++z)
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const glm::dvec3 at_mm = 0.5 * glm::dvec3(x, y, z) - 9.75;
                const bool is_nerve = glm::length(glm::dvec2(at_mm.y - 8.0, at_mm.z)) < 1.0;
                const double radius_mm = glm::length(at_mm);
                out.put(is_nerve ? '\3' : radius_mm < 3.0 ? '\2' : radius_mm < 6.0 ? '\1' : '\0');
            }
}

TEST_F(CaseFolder, IsMadeOfLabelsAlone) {
    const std::filesystem::path labels = where / "jaw.seg.nrrd";
    write_jaw_labels(labels);
    std::ostringstream messages;
    const BegunCase begun = read_case_parts(
        {.labels = {labels}, .is_protected = {"Mandibular_canal"}, .materials = {{"thing", "enamel"}}});
    begin_case(folder);
    const ImportOptions options{.input = labels,
                                .output = bone_of_case(folder),
                                .spacing_mm = 0.2,
                                .threshold_hu = threshold_of_labels_hu,
                                .follows_contours = false};
    import_bone(options, scan_of_labels(begun, messages), {.messages = messages});
    finish_case(folder, begun, messages);
    EXPECT_THAT(messages.str(), HasSubstr("\"Mandible\" is made of cortical bone"));
    EXPECT_THAT(messages.str(), HasSubstr("\"thing\" is made of enamel"));
    EXPECT_THAT(messages.str(), HasSubstr("\"Mandibular canal\" is no bone"));
    const Scene read = scene();
    ASSERT_EQ(read.tissues.size(), 3U);
    EXPECT_EQ(read.tissues[0].strength->material, "cortical bone");
    EXPECT_EQ(read.tissues[1].strength->material, "enamel");
    EXPECT_FALSE(read.tissues[2].strength);
    const LoadedBone loaded = load_bone(read);
    const std::vector<double>& mm3 = loaded.source.loaded_mm3;
    const double ball_mm3 = 4.0 / 3.0 * std::numbers::pi * 27.0;
    EXPECT_NEAR(mm3[2], ball_mm3, 0.01 * ball_mm3);
    EXPECT_NEAR(mm3[1], 7.0 * ball_mm3, 0.07 * ball_mm3);
    EXPECT_LT(mm3[0], 0.01 * ball_mm3) << "no gap between them";
    EXPECT_EQ(mm3.size() > 3 ? mm3[3] : 0.0, 0.0) << "no bone";
    ASSERT_EQ(loaded.structures.size(), 1U);
    EXPECT_NEAR(loaded.structures[0].mask.volume_mm3(), std::numbers::pi * 19.7,
                0.07 * std::numbers::pi * 19.7);
}

TEST_F(CaseFolder, OfALargeRegionIsCoarserWhereNobodyChose) {
    const std::filesystem::path scan = where / "head.nrrd";
    {
        std::ofstream out(scan, std::ios::binary);
        out << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
               "space directions: (20,0,0) (0,20,0) (0,0,20)\nspace origin: (0,0,0)\nencoding: raw\n\n"
            << std::string(512, '\xfa');
    }
    // Printed before the scan is read, where this test ends: the rest takes a while.
    struct Ends {};
    const auto voxels_of = [&](bool may_be_coarser) {
        std::ostringstream messages;
        const ImportOptions options{.input = scan,
                                    .output = where / "bone.nrrd",
                                    .may_be_coarser = may_be_coarser,
                                    .threshold_hu = 200.0};
        EXPECT_THROW(import_bone(options, {.messages = messages, .go_on = [] { throw Ends(); }}), Ends);
        return messages.str();
    };
    EXPECT_THAT(voxels_of(true), AllOf(HasSubstr("large to drill: voxels of 0.25 mm instead of 0.10"),
                                       HasSubstr("become 561 x 561 x 561 of 0.25 mm")));
    EXPECT_THAT(voxels_of(false), HasSubstr("become 1401 x 1401 x 1401 of 0.1 mm"));
}

TEST_F(CaseFolder, OfLabelsSaysWhatIsWrongWithThem) {
    const std::filesystem::path labels = where / "jaw.seg.nrrd";
    write_jaw_labels(labels);
    const auto refusal = [](const CaseParts& parts) {
        return testing::message_of<std::runtime_error>([&] {
            std::ostringstream messages;
            scan_of_labels(read_case_parts(parts), messages);
        });
    };
    EXPECT_THAT(refusal({.labels = {labels}, .materials = {{"thing", "enamle"}}}),
                HasSubstr("did you mean \"enamel\"?"));
    EXPECT_THAT(refusal({.labels = {labels}, .materials = {{"thin", "enamel"}}}),
                HasSubstr("did you mean \"thing\"?"));
    EXPECT_THAT(refusal({.labels = {labels}, .materials = {{"Mandible", "soft"}}}),
                HasSubstr("none of its segments is bone"));
    EXPECT_THAT(refusal({.labels = {labels, segmentation}}), HasSubstr("its voxels are not those of"));
}

TEST(SceneOfCase, IsAFolderOrBuiltIn) {
    EXPECT_EQ(scene_of_case("tooth"), "tooth");
    try {
        scene_of_case("tooht");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("built in are"));
        EXPECT_THAT(error.what(), HasSubstr("did you mean tooth?"));
    }
    const testing::TemporaryFolder folder;
    EXPECT_THROW(scene_of_case(folder.path().string()), std::invalid_argument);
    std::ofstream(folder / "case.toml") << "name = 'x'\n";
    EXPECT_EQ(scene_of_case(folder.path().string()), (folder / "case.toml").string());
    EXPECT_EQ(name_of_case(folder.path() / ""), folder.path().filename().string());
}

TEST(CasePlacement, IsReadAsItWasWritten) {
    const testing::TemporaryFolder folder;
    EXPECT_FALSE(placement_of_case(folder.path()));
    const ToolPose pose{{-40.0, 22.5, 750.125}, glm::normalize(glm::dvec3(1.0, -2.0, 0.5))};
    remember_placement(folder.path(), pose);
    const auto read = placement_of_case(folder.path());
    ASSERT_TRUE(read);
    EXPECT_LT(glm::distance(read->position_mm, pose.position_mm), 1e-3);
    EXPECT_LT(glm::distance(read->spindle_axis, pose.spindle_axis), 1e-5);
}

TEST(CasePlacement, IsRefusedWithItsLineWhereItIsNone) {
    const testing::TemporaryFolder folder;
    for (const auto& [text, words] :
         {std::pair("position_mm = [ 1, 2 ]\n", "position_mm"),
          std::pair("position_mm = [ 1, 2, 3 ]\n", "spindle_axis"),
          std::pair("position_mm = [ 1, 2, 3 ]\nspindle_axis = [ 0, 0, 0 ]\n", "has no length"),
          std::pair("position_mm = [ 1, 2, 3 ]\nspindle_axis = [ 0, 0, 1 ]\nspeed = 1\n", "speed"),
          std::pair("not toml", "placement.toml:1")}) {
        std::ofstream(folder / "placement.toml") << text;
        try {
            placement_of_case(folder.path());
            FAIL() << text;
        } catch (const SceneError& error) {
            EXPECT_THAT(error.what(), HasSubstr(words));
            EXPECT_THAT(error.what(), HasSubstr("placement.toml"));
        }
    }
}

}  // namespace
}  // namespace osteomill
