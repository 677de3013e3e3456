#include "imaging/case/scene_on_bone.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "tests/support/block.h"

namespace osteomill {
namespace {

TEST(SceneOnBone, StartsOutsideTheBoneWhereItIsThinnestAndDrillsThere) {
    Scene scene = scene_of_bone_file("/scans/jaw.nrrd");
    EXPECT_EQ(scene.name, "jaw");
    EXPECT_EQ(scene.description, "") << "it is not the tooth, whose burrs it takes";
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

/// A box of bone with a ball of label 1 in it.
Bone with_target(const Grid& grid, const glm::dvec3& target_mm) {
    return filled(BoneBuilder::homogeneous(grid, 1.0, true), grid, [&](const glm::ivec3& voxel) {
        const glm::dvec3 at_mm = centre_of_voxel_mm(grid, voxel);
        const bool is_bone = glm::all(glm::lessThan(glm::abs(at_mm), glm::dvec3(8.0)));
        const bool is_target = glm::distance(at_mm, target_mm) < 1.5;
        return VoxelValues{.fraction = static_cast<std::uint8_t>(is_bone ? 255 : 0),
                           .tissue = static_cast<std::uint8_t>(is_target ? 1 : 0)};
    });
}

TEST(SceneOnBone, LooksAtItsTargetFromTheNearestFreeSide) {
    const Grid all{.size_voxels = {100, 100, 100}, .spacing_mm = 0.25, .origin_mm = glm::dvec3(-12.375)};
    Scene scene = scene_of_bone_file("x.nrrd");
    scene.tissues = {{.label = 1, .name = "tumour"}};
    scene.plan = Plan{.region = TissueRegion{"tumour"}};
    for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)}) {
        place_on_bone(scene, with_target(all, 5.0 * side));
        EXPECT_EQ(scene.start_pose.spindle_axis, side);
        EXPECT_NEAR(glm::dot(scene.start_pose.position_mm, side),
                    8.0 + 3.0 + scene.burrs[scene.start_burr].radius_mm(), 0.3);
        EXPECT_NEAR(glm::dot(scene.trajectory.start_mm, side), 8.0, 0.3);
        EXPECT_NEAR(glm::length(glm::cross(scene.start_pose.position_mm, side)), 0.0, 0.2);
    }
    // The grid ends within the bone on that side: it is not free.
    const Grid cut{.size_voxels = {76, 100, 100}, .spacing_mm = 0.25, .origin_mm = glm::dvec3(-12.375)};
    place_on_bone(scene, with_target(cut, {4.0, 0.0, 3.0}));
    EXPECT_EQ(scene.start_pose.spindle_axis, glm::dvec3(0.0, 0.0, 1.0));
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
