#include "imaging/bone_file/carved_bone.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <random>

#include "common/bone/bone_builder.h"
#include "imaging/formats/image_reader.h"
#include "imaging/imaging_error.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_image.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

constexpr double threshold_hu = 300.0;

/// Bone of varying HU in soft tissue, on a grid that ends within a brick.
HuVolume ball(bool labelled) {
    HuVolume volume{.grid = {.size_voxels = {37, 35, 33}, .spacing_mm = 0.1, .origin_mm = {1.0, 2.0, 3.0}},
                    .hu = {},
                    .tissue = {}};
    for (int z = 0; z < 33; ++z)
        for (int y = 0; y < 35; ++y)
            for (int x = 0; x < 37; ++x) {
                const double away = std::hypot(x - 18.0, y - 17.0, z - 16.0);
                volume.hu.push_back(
                    static_cast<std::int16_t>(std::lround(1900.0 - 130.0 * away + 20.0 * (x % 3))));
                if (labelled) volume.tissue.push_back(away < 6.0 ? 2 : 1);
            }
    return volume;
}

/// Half milled away, with partial voxels between.
Bone carved(const HuVolume& volume) {
    Bone bone = bone_from_hu(volume, threshold_hu, default_stiffness_relation());
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 brick =
            brick_position(bone.content().size_bricks, bone.content().brick_of_slot[slot]);
        const auto left = bone.fractions(static_cast<std::int32_t>(slot));
        for (std::size_t i = 0; i < left.size(); ++i) {
            const int x = brick_edge_voxels * brick.x + voxel_in_brick(i).x;
            if (x > 20) left[i] = 0;
            if (x == 20) left[i] = std::min<std::uint8_t>(left[i], 77);
        }
    }
    return bone;
}

class CarvedBone : public ::testing::TestWithParam<bool> {
  protected:
    std::string refusal() {
        return testing::message_of<ImagingError>([&] { restore_carved_bone(BoneFile(path_)); });
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "carved.nrrd";
};

TEST_P(CarvedBone, ComesBackBitForBit) {
    const HuVolume volume = ball(GetParam());
    const Bone bone = carved(volume);
    save_carved_bone(path_, slices_of(volume), bone, {{threshold_key, "300"}});
    const BoneFile opened(path_);
    ASSERT_TRUE(is_carved(opened));
    const testing::DenseBoneFile file = testing::read_bone_file(path_);
    EXPECT_EQ(file.threshold_hu, 300.0);
    const Bone again = restore_carved_bone(opened).bone;
    EXPECT_EQ(checksum(again), checksum(bone));
    std::size_t i = 0;
    for (int z = 0; z < 33; ++z)
        for (int y = 0; y < 35; ++y)
            for (int x = 0; x < 37; ++x, ++i) {
                const glm::ivec3 voxel(x, y, z);
                ASSERT_EQ(again.fraction_at(voxel), bone.fraction_at(voxel));
                if (bone.fraction_at(voxel) > 0) {
                    ASSERT_EQ(again.stiffness_at(voxel), bone.stiffness_at(voxel));
                    ASSERT_EQ(again.tissue_at(voxel), bone.tissue_at(voxel));
                }
                const bool milled = x > 20 && volume.hu[i] >= threshold_hu;
                if (milled) {
                    ASSERT_EQ(file.volume.hu[i], milled_away_hu);
                } else if (x <= 20) {
                    ASSERT_EQ(file.volume.hu[i], volume.hu[i]);
                }
            }
}

TEST_P(CarvedBone, IsOneFileThatBoneImportReads) {
    const HuVolume volume = ball(GetParam());
    save_carved_bone(path_, slices_of(volume), carved(volume));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
    const OpenedImage opened = open_image(path_);
    const std::vector<float> values = values_of(opened);
    const std::vector<std::int16_t> hu = testing::read_bone_file(path_).volume.hu;
    ASSERT_EQ(values.size(), hu.size());
    EXPECT_TRUE(std::equal(values.begin(), values.end(), hu.begin())) << "behind the bytes to be skipped";
}

TEST_P(CarvedBone, IsSavedOverItself) {
    const HuVolume volume = ball(GetParam());
    const Bone bone = carved(volume);
    save_carved_bone(path_, slices_of(volume), bone);
    const std::vector<std::int16_t> hu = testing::read_bone_file(path_).volume.hu;
    const BoneFile file(path_);
    HuReader reader(file);
    save_carved_bone(path_, slices_of(reader, file), bone);
    EXPECT_EQ(checksum(restore_carved_bone(BoneFile(path_)).bone), checksum(bone));
    EXPECT_EQ(testing::read_bone_file(path_).volume.hu, hu);
}

TEST_P(CarvedBone, StaysAsItWasWhereTheNewOneCannotBeMade) {
    const HuVolume volume = ball(GetParam());
    save_carved_bone(path_, slices_of(volume), carved(volume));
    const std::uint64_t before = checksum(restore_carved_bone(BoneFile(path_)).bone);
    const Bone whole = bone_from_hu(volume, threshold_hu, default_stiffness_relation());
    HuSlices ends_early = slices_of(volume);
    ends_early.read = [](std::span<std::int16_t>, std::span<std::uint8_t>) {
        throw ImagingError("the source is gone");
    };
    EXPECT_THROW(save_carved_bone(path_, ends_early, whole), ImagingError);
    {
        const testing::FileSizeLimit full_disk(4000);
        EXPECT_THROW(save_carved_bone(path_, slices_of(volume), whole), std::runtime_error);
    }
    EXPECT_EQ(checksum(restore_carved_bone(BoneFile(path_)).bone), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1)
        << "nothing is left beside";
}

/// Decodes a bone file, changes a byte of the data, encodes it with a CRC that fits: only a digest finds such
/// damage.
void change_byte(const std::filesystem::path& path, std::uint64_t at) {
    const BoneFile file(path);
    std::vector<std::byte> bytes(
        static_cast<std::size_t>(file.form().bytes_before_voxels + 2 * voxel_count(file.form().grid)));
    NrrdData data = file.data();
    data.read_before_voxels(bytes);
    bytes[static_cast<std::size_t>(at)] ^= std::byte{1};
    NrrdWriter writer(path, file.form());
    writer.add(bytes);
    writer.commit(file.form().key_values);
}

TEST_P(CarvedBone, NamesTheChannelThatIsDamaged) {
    const HuVolume volume = ball(GetParam());
    const Bone bone = carved(volume);
    const auto refused = [&](auto at) {
        save_carved_bone(path_, slices_of(volume), bone);
        change_byte(path_, at(BoneFile(path_).form().bytes_before_voxels));
        return refusal();
    };
    const auto byte_of_brick = [](std::uint64_t byte) { return [=](std::uint64_t) { return byte; }; };
    EXPECT_THAT(refused(byte_of_brick(3)),
                HasSubstr("its fractions (what is left of each voxel) are damaged"));
    EXPECT_THAT(refused(byte_of_brick(2000)),
                HasSubstr("its fractions (what is left of each voxel) are damaged"));
    EXPECT_THAT(refused(byte_of_brick(4 + 4096 + 2000)),
                HasSubstr("its stiffness codes are damaged: digest "));
    if (GetParam()) {
        EXPECT_THAT(refused(byte_of_brick(4 + 2 * 4096 + 2000)),
                    HasSubstr("its tissue labels are damaged: digest "));
    }
    EXPECT_THAT(refused([](std::uint64_t before) { return before + 12345; }),
                HasSubstr("its CT numbers are damaged: digest "));
}

TEST_P(CarvedBone, IsRefusedOrTheSameWithAnyBitFlipped) {
    const HuVolume volume = ball(GetParam());
    const Bone bone = carved(volume);
    save_carved_bone(path_, slices_of(volume), bone, {{threshold_key, "300"}});
    std::ifstream saved(path_, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(saved), {});
    const std::size_t header_bytes = text.find("\n\n");
    std::mt19937 random(17);
    int harmless = 0;
    // Half of the flips in the header, which is short.
    for (int round = 0; round < 400; ++round) {
        std::string flipped = text;
        const std::size_t range = round % 2 == 0 ? header_bytes : text.size();
        const std::size_t at = std::uniform_int_distribution<std::size_t>(0, range - 1)(random);
        flipped[at] = static_cast<char>(flipped[at] ^ (1 << (random() % 8)));
        std::ofstream(path_, std::ios::binary) << flipped;
        try {
            const BoneFile file(path_);
            const RestoredBone restored = restore_carved_bone(file);
            EXPECT_EQ(checksum(restored.bone), checksum(bone)) << at;
            EXPECT_EQ(restored.bone.content().stiffness.size(), bone.content().stiffness.size()) << at;
            EXPECT_EQ(restored.bone.content().tissue.size(), bone.content().tissue.size()) << at;
            EXPECT_EQ(restored.bone.grid(), bone.grid()) << at;
            EXPECT_EQ(file.threshold_hu(), 300.0) << at;
            ++harmless;
        } catch (const ImagingError&) {
        }
    }
    EXPECT_LT(harmless, 150) << "comments, names of digests, gzip's time stamp";
}

TEST(CarvedBoneOf01, IsRefusedByThatName) {
    const testing::TemporaryFolder folder;
    const HuVolume volume = ball(false);
    NrrdForm form{.voxel = NrrdVoxel::int16,
                  .grid = volume.grid,
                  .key_values = {{"osteomill_fraction_file", "carved.fraction.nrrd"}}};
    NrrdWriter writer(folder / "carved.nrrd", form);
    writer.add(std::as_bytes(std::span(volume.hu)));
    writer.commit(form.key_values);
    const BoneFile file(folder / "carved.nrrd");
    EXPECT_TRUE(is_carved(file));
    EXPECT_THROW(
        {
            try {
                restore_carved_bone(file);
            } catch (const ImagingError& error) {
                EXPECT_THAT(error.what(), ::testing::HasSubstr("was saved by version 0.1"));
                throw;
            }
        },
        ImagingError);
}

INSTANTIATE_TEST_SUITE_P(UnlabelledAndLabelled, CarvedBone, ::testing::Bool());

TEST(CarvedBoneHomogeneous, KeepsItsStiffness) {
    const testing::TemporaryFolder folder;
    HuVolume volume{
        .grid = {.size_voxels = {20, 18, 17}, .spacing_mm = 0.1, .origin_mm = {}}, .hu = {}, .tissue = {}};
    volume.hu.assign(20 * 18 * 17, 1600);
    const Bone bone = bone_from_hu(volume, threshold_hu, default_stiffness_relation());
    save_carved_bone(folder / "cube.nrrd", slices_of(volume), bone);
    const Bone again = restore_carved_bone(BoneFile(folder / "cube.nrrd")).bone;
    EXPECT_EQ(checksum(again), checksum(bone));
    EXPECT_EQ(again.stiffness_at({3, 3, 3}), bone.stiffness_at({3, 3, 3}));
    EXPECT_TRUE(again.content().stiffness.empty());
}

TEST(CarvedBoneWithoutSource, ShowsWhereBoneIsLeft) {
    const HuVolume volume = ball(false);
    const Bone bone = carved(volume);
    const HuSlices slices = picture_of(bone);
    EXPECT_EQ(slices.grid, bone.grid()) << "it is small";
    std::vector<std::int16_t> hu(volume.hu.size());
    slices.read(hu, {});
    const auto at = [&](int x, int y, int z) { return hu[static_cast<std::size_t>(x + 37 * (y + 35 * z))]; };
    EXPECT_EQ(at(18, 17, 16), 1600);
    EXPECT_NEAR(at(20, 17, 16), -1000 + 2600 * 77 / 255, 1);
    EXPECT_EQ(at(21, 17, 16), -1000);
    EXPECT_EQ(at(0, 0, 0), -1000);
}

/// A bone of one brick in a corner of a large grid, one layer of its voxels gone.
Bone small_in_large(const Grid& grid) {
    ByteBrick fractions{};
    for (std::size_t i = 0; i < fractions.size(); ++i) fractions[i] = voxel_in_brick(i).z == 0 ? 0 : 255;
    BoneBuilder builder = BoneBuilder::homogeneous(grid, 1.0, false);
    builder.add_brick({2, 1, 3}, fractions, nullptr, nullptr);
    return std::move(builder).build();
}

TEST(CarvedBoneWithoutSource, ShowsALargeOneInLongerVoxels) {
    const Grid grid{.size_voxels = {1026, 1024, 1024}, .spacing_mm = 0.1, .origin_mm = {1.0, 2.0, 3.0}};
    const Bone bone = small_in_large(grid);
    const testing::TemporaryFolder folder;
    save_carved_bone(folder / "large.nrrd", bone);
    const BoneFile file(folder / "large.nrrd");
    EXPECT_EQ(file.grid(),
              (Grid{.size_voxels = {257, 256, 256}, .spacing_mm = 0.4, .origin_mm = {1.15, 2.15, 3.15}}));
    const std::vector<std::int16_t> hu = testing::read_bone_file(folder / "large.nrrd").volume.hu;
    const auto at = [&](int x, int y, int z) {
        return hu[static_cast<std::size_t>(x + 257 * (y + 256 * z))];
    };
    EXPECT_EQ(at(8, 4, 13), 1600);
    EXPECT_EQ(at(11, 7, 12), 950) << "three quarters are left";
    EXPECT_EQ(at(7, 4, 13), -1000);
    const Bone again = restore_carved_bone(file).bone;
    EXPECT_EQ(again.grid(), grid);
    EXPECT_EQ(checksum(again), checksum(bone));
    save_carved_bone(folder / "again.nrrd", again);
    EXPECT_EQ(checksum(restore_carved_bone(BoneFile(folder / "again.nrrd")).bone), checksum(bone));
}

}  // namespace
}  // namespace osteomill
