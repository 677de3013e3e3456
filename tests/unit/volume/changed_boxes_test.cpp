#include <gtest/gtest.h>

#include "render_client/volume/textures/voxel_box.h"
#include "studies/render/made_bone.h"

namespace osteomill {
namespace {

BrickChange change_of(BrickIndex brick, std::initializer_list<glm::ivec3> voxels) {
    BrickChange change{.brick = brick};
    for (const glm::ivec3& voxel : voxels) change.voxels.set(offset_in_brick(voxel));
    return change;
}

TEST(ChangedBoxes, AreTheSmallestRoundWhatChangedInEachBrick) {
    const Bone bone = made_bone({.size_voxels = {32, 32, 32}}, [](const glm::dvec3&) { return 1.0; });
    const std::vector<BrickChange> changes{
        change_of(0, {{3, 15, 0}, {12, 2, 7}}),
        change_of(1, {}),
        change_of(7, {{16, 31, 31}}),
        change_of(4000, {{0, 0, 0}}),  // not stored
        {.brick = 2, .voxels = VoxelMask().set_all()},
    };
    EXPECT_EQ(changed_boxes(bone.content(), changes),
              (std::vector<VoxelBox>{
                  {{0, 2, 0}, {16, 14, 8}}, {{16, 31, 31}, {4, 1, 1}}, {{0, 16, 0}, {16, 16, 16}}}));
}

}  // namespace
}  // namespace osteomill
