#include "haptic_server/imaging/carved_bone.h"

#include <gmock/gmock.h>

#include <cmath>

#include "haptic_server/imaging/imaging_error.h"
#include "tests/support/temporary_folder.h"

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
        try {
            restore_carved_bone(path_, read_bone_file(path_));
        } catch (const ImagingError& error) {
            return error.what();
        }
        return "accepted";
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "carved.nrrd";
};

TEST_P(CarvedBone, ComesBackBitForBit) {
    const HuVolume volume = ball(GetParam());
    const Bone bone = carved(volume);
    save_carved_bone(path_, volume, bone, {{threshold_key, "300"}});
    const BoneFile file = read_bone_file(path_);
    ASSERT_TRUE(is_carved(file));
    EXPECT_EQ(file.threshold_hu, 300.0);
    const Bone again = restore_carved_bone(path_, file);
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

INSTANTIATE_TEST_SUITE_P(UnlabelledAndLabelled, CarvedBone, ::testing::Bool());

using CarvedBoneFaults = CarvedBone;

TEST_P(CarvedBoneFaults, AreSaidInOneLine) {
    const HuVolume volume = ball(false);
    const Bone bone = carved(volume);
    save_carved_bone(path_, volume, bone);
    save_carved_bone(folder_ / "other.nrrd", volume,
                     bone_from_hu(volume, threshold_hu, default_stiffness_relation()));
    std::filesystem::rename(folder_ / "other.fraction.nrrd", folder_ / "carved.fraction.nrrd");
    EXPECT_THAT(refusal(), HasSubstr("is of another carving"));

    HuVolume smaller{
        .grid = {.size_voxels = {16, 16, 16}, .spacing_mm = 0.1, .origin_mm = {}}, .hu = {}, .tissue = {}};
    smaller.hu.assign(16 * 16 * 16, 900);
    save_carved_bone(folder_ / "other.nrrd", smaller,
                     bone_from_hu(smaller, threshold_hu, default_stiffness_relation()));
    std::filesystem::rename(folder_ / "other.fraction.nrrd", folder_ / "carved.fraction.nrrd");
    EXPECT_THAT(refusal(), HasSubstr("grid is not that of"));

    std::filesystem::remove(folder_ / "carved.fraction.nrrd");
    EXPECT_THAT(refusal(), HasSubstr("carved.fraction.nrrd is missing"));
}

INSTANTIATE_TEST_SUITE_P(Once, CarvedBoneFaults, ::testing::Values(false));

TEST(CarvedBoneHomogeneous, KeepsItsStiffness) {
    const testing::TemporaryFolder folder;
    HuVolume volume{
        .grid = {.size_voxels = {20, 18, 17}, .spacing_mm = 0.1, .origin_mm = {}}, .hu = {}, .tissue = {}};
    volume.hu.assign(20 * 18 * 17, 1600);
    const Bone bone = bone_from_hu(volume, threshold_hu, default_stiffness_relation());
    save_carved_bone(folder / "cube.nrrd", volume, bone);
    const Bone again = restore_carved_bone(folder / "cube.nrrd", read_bone_file(folder / "cube.nrrd"));
    EXPECT_EQ(checksum(again), checksum(bone));
    EXPECT_EQ(again.stiffness_at({3, 3, 3}), bone.stiffness_at({3, 3, 3}));
    EXPECT_TRUE(again.content().stiffness.empty());
}

}  // namespace
}  // namespace osteomill
