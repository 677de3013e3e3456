#include "render_client/volume/textures/voxel_box.h"

#include <gtest/gtest.h>

#include "studies/render/made_bone.h"

namespace osteomill::voxel_box_test {
namespace {

const Grid grid{.size_voxels = {70, 50, 40}, .origin_mm = {0.0, 0.0, 0.0}};

TEST(VoxelBox, EnclosesJustTheStoredBricks) {
    const Bone bone =
        made_bone(grid, [](const glm::dvec3& p) { return 0.5 - glm::length(p - glm::dvec3(4.0, 2.4, 2.4)); });
    EXPECT_EQ(stored_box(bone.content()), (VoxelBox{{32, 16, 16}, {16, 16, 16}}));
}

TEST(VoxelBox, IsEmptyForABoneWithoutBricks) {
    const Bone bone = made_bone(grid, [](const glm::dvec3&) { return -1.0; });
    EXPECT_EQ(stored_box(bone.content()).count(), 0u);
}

TEST(VoxelBox, CopiesWhatTheBoneHoldsAndZeroBeyondTheGrid) {
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return 1.7 - glm::length(p - glm::dvec3(3.0, 2.0, 2.0)); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(1.0 + p.x); });
    const VoxelBox box{{-3, 5, 11}, {77, 49, 31}};
    std::vector<std::uint8_t> fraction(box.count()), tissue(box.count());
    copy_channel(bone, BoneChannel::fraction, box, fraction);
    copy_channel(bone, BoneChannel::tissue, box, tissue);
    std::size_t place = 0;
    for (int z = 0; z < box.size.z; ++z)
        for (int y = 0; y < box.size.y; ++y)
            for (int x = 0; x < box.size.x; ++x, ++place) {
                const glm::ivec3 voxel = box.first + glm::ivec3(x, y, z);
                ASSERT_EQ(fraction[place], bone.fraction_at(voxel));
                ASSERT_EQ(tissue[place], bone.tissue_at(voxel));
            }
}

}  // namespace
}  // namespace osteomill::voxel_box_test
