#include "haptic_server/program/scene_on_bone.h"

#include <gtest/gtest.h>

#include "tests/support/block.h"

namespace osteomill {
namespace {

TEST(SceneOnBone, StartsAboveTheHighestBoneInTheMiddleAndDrillsThere) {
    Scene scene = scene_of_bone_file("/scans/jaw.nrrd");
    EXPECT_EQ(scene.name, "jaw");
    EXPECT_EQ(std::get<FileSource>(scene.bone).path, "/scans/jaw.nrrd");
    EXPECT_TRUE(scene.tissues.empty());
    place_on_bone(scene, testing::make_block({100.0, -50.0, 20.0}, {110.0, -42.0, 25.0}, 0.1));
    const glm::dvec3 mouth = scene.trajectory.start_mm;
    EXPECT_NEAR(mouth.z, 25.0, 0.06);
    EXPECT_NEAR(mouth.x, 105.0, 2.6);
    EXPECT_NEAR(mouth.y, -46.0, 2.1);
    EXPECT_GT(scene.start_pose.position_mm.z, 25.0 + scene.burrs[scene.start_burr].radius_mm());
    EXPECT_EQ(scene.start_pose.position_mm.x, mouth.x);
}

TEST(SceneOnBone, ABoneOfWhichNothingIsLeftIsNoError) {
    auto builder = BoneBuilder::homogeneous(Grid{.size_voxels = {16, 16, 16}}, 1.0, false);
    const Bone nothing = std::move(builder).build();
    Scene scene = scene_of_bone_file("x.nrrd");
    const Scene before = scene;
    place_on_bone(scene, nothing);
    EXPECT_EQ(scene, before);
}

}  // namespace
}  // namespace osteomill
