#include "render_client/volume/textures/changed_voxels.h"

#include <gtest/gtest.h>

#include "tests/unit/volume/made_bone.h"

namespace osteomill::changed_voxels_test {
namespace {

Bone block() {
    return made_bone({.size_voxels = {32, 32, 32}}, [](const glm::dvec3&) { return 1.0; });
}

void set(Bone& bone, const glm::ivec3& voxel, std::uint8_t fraction) {
    bone.fractions(bone.slot(voxel / brick_edge_voxels))[offset_in_brick(voxel)] = fraction;
}

TEST(ChangedVoxels, AreBoxedInEachBrickThatDiffersFromLastTime) {
    Bone bone = block();
    ChangedVoxels changed(bone);
    const std::vector<BrickIndex> all(bone.content().brick_of_slot);
    EXPECT_TRUE(changed.since_last(bone, all).empty());

    set(bone, {3, 15, 0}, 254);
    set(bone, {12, 2, 7}, 0);
    set(bone, {16, 31, 31}, 1);
    const auto boxes = changed.since_last(bone, all);
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_EQ(boxes[0], (VoxelBox{{0, 2, 0}, {16, 14, 8}}));
    EXPECT_EQ(boxes[1], (VoxelBox{{16, 31, 31}, {4, 1, 1}}));
    EXPECT_TRUE(changed.since_last(bone, all).empty());

    set(bone, {9, 4, 4}, 7);
    set(bone, {30, 4, 4}, 7);
    const auto of_one = changed.since_last(bone, std::vector{all[1], BrickIndex{4000}});
    ASSERT_EQ(of_one.size(), 1u) << "the other brick was not asked for, the third is not there";
    EXPECT_EQ(of_one[0], (VoxelBox{{28, 4, 4}, {4, 1, 1}}));
    const auto of_the_rest = changed.since_last(bone, all);
    ASSERT_EQ(of_the_rest.size(), 1u);
    EXPECT_EQ(of_the_rest[0], (VoxelBox{{8, 4, 4}, {4, 1, 1}}));
}

}  // namespace
}  // namespace osteomill::changed_voxels_test
