#include "analysis/surface/export_bone.h"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>

#include "imaging/bone_file/carved_bone.h"
#include "imaging/bone_file/hu_file.h"
#include "imaging/formats/image_reader.h"
#include "tests/support/hu_volume.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_image.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

ParseResult<ExportOptions> parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "bone_export");
    return parse_export_command_line(static_cast<int>(arguments.size()), arguments.data(), "0.0.test");
}

std::string refusal(const std::function<void()>& act) {
    return testing::message_of<std::exception>([&] { act(); });
}

TEST(ExportCommandLine, TakesASurfaceOrWhatWasRemoved) {
    EXPECT_EQ(parse({"a.nrrd", "a.stl"}).options->output, "a.stl");
    EXPECT_EQ(parse({"a.nrrd", "a.stl", "--threshold-hu", "250"}).options->threshold_hu, 250.0);
    EXPECT_EQ(parse({"a.nrrd", "a.stl", "--spacing-mm", "0.4"}).options->cell_mm, 0.4);
    EXPECT_EQ(parse({"a.nrrd", "d.nrrd", "--removed", "b.nrrd"}).options->original, "b.nrrd");
    EXPECT_THAT(parse({"--help"}).text, HasSubstr("--removed"));
    EXPECT_EQ(parse({"--version"}).text, "bone_export 0.0.test\n");
    for (const std::vector<const char*>& wrong :
         {std::vector<const char*>{},
          {"a.nrrd"},
          {"a.nrrd", "a.step"},
          {"a.nrrd", "b.nrrd"},
          {"a.nrrd", "a.stl", "--removed", "b.nrrd"},
          {"a.nrrd", "a.nrrd", "--removed", "b.nrrd"},
          {"a.nrrd", "b.nrrd", "--removed", "b.nrrd"},
          {"a.nrrd", "a.stl", "--spacing-mm", "0"},
          {"a.nrrd", "d.nrrd", "--removed", "b.nrrd", "--spacing-mm", "1"},
          {"a.nrrd", "a.stl", "--threshold-hu", "much"}})
        EXPECT_THROW(parse(wrong), std::invalid_argument);
}

class Export : public ::testing::Test {
  protected:
    /// A cube of bone in soft tissue.
    void write_original(const std::string& name, const Grid& grid) {
        BoneFileWriter writer(folder_ / name, grid, {{threshold_key, threshold_text(500.0)}});
        writer.add(hu_of(grid).hu);
        writer.commit();
    }
    static HuVolume hu_of(const Grid& grid) {
        HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
        for (int z = 0; z < grid.size_voxels.z; ++z)
            for (int y = 0; y < grid.size_voxels.y; ++y)
                for (int x = 0; x < grid.size_voxels.x; ++x) {
                    const bool is_bone = std::min({x, y, z}) >= 4 && std::max({x, y, z}) < 20;
                    volume.hu.push_back(is_bone ? 1200 : 40);
                }
        return volume;
    }
    std::string said(const ExportOptions& options) {
        std::string all;
        export_bone(
            options, [&](const std::string& line) { all += line; }, [](double) {});
        return all;
    }

    const testing::TemporaryFolder folder_;
    const Grid grid_{.size_voxels = {24, 24, 37}, .spacing_mm = 0.2, .origin_mm = {1.0, -2.0, 700.0}};
};

TEST_F(Export, ThatIsStoppedAnywhereWritesNothing) {
    write_original("original.nrrd", grid_);
    const ExportOptions options{.bone = folder_ / "original.nrrd", .output = folder_ / "surface.stl"};
    constexpr int parts = 3;
    for (int stopped_at = 0; stopped_at < parts; ++stopped_at) {
        int part = 0;
        const auto stop = [&](double) {
            if (part++ == stopped_at) throw std::runtime_error("stopped");
        };
        EXPECT_THROW(export_bone(
                         options, [](const std::string&) {}, stop),
                     std::runtime_error);
        EXPECT_EQ(part, stopped_at + 1);
        EXPECT_FALSE(std::filesystem::exists(options.output));
    }
    EXPECT_THAT(said(options), ::testing::HasSubstr("triangles"));
}

TEST_F(Export, OfACarvedBoneGivesWhatIsGoneOfEachVoxel) {
    write_original("original.nrrd", grid_);
    const HuVolume volume = hu_of(grid_);
    Bone bone = bone_from_hu(volume, 500.0, default_stiffness_relation());
    const Bone before = bone;
    std::mt19937 random(3);
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        for (std::uint8_t& fraction : bone.fractions(static_cast<std::int32_t>(slot)))
            if (random() % 3 == 0) fraction = static_cast<std::uint8_t>(fraction / (1 + random() % 3));
    save_carved_bone(folder_ / "carved.nrrd", slices_of(volume), bone,
                     {{threshold_key, threshold_text(500.0)}});

    EXPECT_THAT(said({.bone = folder_ / "carved.nrrd",
                      .output = folder_ / "gone.nrrd",
                      .original = folder_ / "original.nrrd"}),
                HasSubstr("mm^3 removed"));
    const OpenedImage file = open_image(folder_ / "gone.nrrd");
    EXPECT_EQ(file.image.origin_mm, grid_.origin_mm);
    const std::vector<float> gone = values_of(file);
    ASSERT_EQ(gone.size(), voxel_count(grid_));
    std::size_t i = 0;
    for (int z = 0; z < grid_.size_voxels.z; ++z)
        for (int y = 0; y < grid_.size_voxels.y; ++y)
            for (int x = 0; x < grid_.size_voxels.x; ++x, ++i)
                ASSERT_EQ(gone[i], before.fraction_at({x, y, z}) - bone.fraction_at({x, y, z}));
    EXPECT_THAT(said({.bone = folder_ / "carved.nrrd", .output = folder_ / "left.stl"}),
                HasSubstr("triangles"));

    // The other way round, and against another scan, a difference would be nonsense.
    EXPECT_THAT(refusal([&] {
                    said({.bone = folder_ / "original.nrrd",
                          .output = folder_ / "gone.nrrd",
                          .original = folder_ / "carved.nrrd"});
                }),
                HasSubstr("was not carved from it"));
    Grid shorter = grid_;
    shorter.size_voxels.z = 30;
    write_original("other.nrrd", shorter);
    EXPECT_THAT(refusal([&] {
                    said({.bone = folder_ / "carved.nrrd",
                          .output = folder_ / "gone.nrrd",
                          .original = folder_ / "other.nrrd"});
                }),
                HasSubstr("lies on another grid"));
}

TEST_F(Export, OfNoBoneSaysSo) {
    write_original("original.nrrd", grid_);
    EXPECT_THAT(
        refusal([&] {
            said({.bone = folder_ / "original.nrrd", .output = folder_ / "a.stl", .threshold_hu = 2000.0});
        }),
        HasSubstr("original.nrrd: holds no bone: no voxel reaches 2000 HU, the highest has 1200"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.stl"));
    EXPECT_THAT(refusal([&] { said({.bone = folder_ / "none.nrrd", .output = folder_ / "a.stl"}); }),
                HasSubstr("none.nrrd"));
}

}  // namespace
}  // namespace osteomill
