#include "common/bone/edit.h"

#include <gtest/gtest.h>

#include "common/bone/bone_builder.h"

namespace osteomill::edit_test {
namespace {

Bone half_stored_bone() {
    auto builder = BoneBuilder::homogeneous(Grid{.size_voxels = {32, 16, 16}}, 1.0, false);
    ByteBrick fraction;
    fraction.fill(100);
    builder.add_brick({0, 0, 0}, fraction, nullptr, nullptr);
    return std::move(builder).build();
}

TEST(Edit, WritesItsRunAndNothingElse) {
    Bone bone = half_stored_bone();
    EXPECT_EQ(apply({.brick = 0, .first_voxel = 30, .count = 2, .fraction = {5, 6}}, bone),
              EditOutcome::applied);
    EXPECT_EQ(bone.fractions(0)[29], 100);
    EXPECT_EQ(bone.fractions(0)[30], 5);
    EXPECT_EQ(bone.fractions(0)[31], 6);
    EXPECT_EQ(bone.fractions(0)[32], 100);
}

TEST(Edit, AppliedTwiceChangesNothingMore) {
    Bone bone = half_stored_bone();
    const EditRun run{.brick = 0, .first_voxel = 0, .count = 16, .fraction = {1, 2, 3}};
    EXPECT_EQ(apply(run, bone), EditOutcome::applied);
    const std::uint64_t once = checksum(bone);
    EXPECT_EQ(apply(run, bone), EditOutcome::applied);
    EXPECT_EQ(checksum(bone), once);
}

TEST(Edit, RefusesWhatDoesNotFitAndLeavesTheBone) {
    Bone bone = half_stored_bone();
    const std::uint64_t before = checksum(bone);
    EXPECT_EQ(apply({.brick = 1, .first_voxel = 0, .count = 1}, bone), EditOutcome::no_such_brick);
    EXPECT_EQ(apply({.brick = 2, .first_voxel = 0, .count = 1}, bone), EditOutcome::no_such_brick);
    EXPECT_EQ(apply({.brick = 0, .first_voxel = 0, .count = 0}, bone), EditOutcome::bad_run);
    EXPECT_EQ(apply({.brick = 0, .first_voxel = 4096, .count = 1}, bone), EditOutcome::bad_run);
    EXPECT_EQ(apply({.brick = 0, .first_voxel = 15, .count = 2}, bone), EditOutcome::bad_run);
    EXPECT_EQ(apply({.brick = 0, .first_voxel = 0, .count = 2, .fraction = {100, 101}}, bone),
              EditOutcome::raises_fraction);
    EXPECT_EQ(checksum(bone), before);
}

}  // namespace
}  // namespace osteomill::edit_test
