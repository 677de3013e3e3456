#include "imaging/resampling/near_bone.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/hu_volume.h"

namespace osteomill {
namespace {

std::uint64_t clear_far_from_bone(HuVolume& volume, double threshold_hu) {
    const glm::ivec3 size = volume.grid.size_voxels;
    // Exactly the slices that are needed: a slice is cleared as soon as those above it have been processed.
    NearBone near(volume.grid, threshold_hu, 2 * kept_voxels_around_bone + 1);
    const auto slice = [&](int z) {
        return std::span(volume.hu).subspan(static_cast<std::size_t>(size.x * size.y * z),
                                            static_cast<std::size_t>(size.x * size.y));
    };
    for (int z = 0; z < size.z + kept_voxels_around_bone; ++z) {
        if (z < size.z) near.look_at(z, slice(z));
        if (z >= kept_voxels_around_bone)
            near.clear_far(z - kept_voxels_around_bone, slice(z - kept_voxels_around_bone));
    }
    return near.bone_voxels();
}

TEST(NearBone, KeepsTwoVoxelsAroundBoneAndClearsTheRest) {
    const Grid grid{.size_voxels = {11, 9, 8}, .spacing_mm = 0.1, .origin_mm = {}};
    HuVolume volume{.grid = grid, .hu = std::vector<std::int16_t>(11 * 9 * 8, 40), .tissue = {}};
    const glm::ivec3 bone(4, 1, 6);
    volume.hu[static_cast<std::size_t>(bone.x + 11 * (bone.y + 9 * bone.z))] = 700;
    EXPECT_EQ(clear_far_from_bone(volume, 300.0), 1u);
    std::size_t i = 0;
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 11; ++x, ++i) {
                const bool near =
                    std::abs(x - bone.x) <= 2 && std::abs(y - bone.y) <= 2 && std::abs(z - bone.z) <= 2;
                const bool is_bone = glm::ivec3(x, y, z) == bone;
                ASSERT_EQ(volume.hu[i], is_bone ? 700 : near ? 40 : -1000) << x << ' ' << y << ' ' << z;
            }
}

TEST(NearBone, CountsNothingWhereNothingReachesTheThreshold) {
    HuVolume volume{.grid = {.size_voxels = {3, 1, 1}, .spacing_mm = 0.1, .origin_mm = {}},
                    .hu = {1, 2, 3},
                    .tissue = {}};
    EXPECT_EQ(clear_far_from_bone(volume, 300.0), 0u);
}

}  // namespace
}  // namespace osteomill
