#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "tests/support/hu_volume.h"

namespace osteomill {
namespace {

constexpr double threshold_hu = 300.0;

/// HU that falls linearly from bone to soft tissue over 4 voxels around a sphere, as a blurred scan would
/// show it.
HuVolume blurred_sphere(double radius_mm) {
    const Grid grid{.size_voxels = {70, 66, 62}, .spacing_mm = 0.1, .origin_mm = {-3.51, -3.27, -3.1}};
    HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
    for (int z = 0; z < 62; ++z)
        for (int y = 0; y < 66; ++y)
            for (int x = 0; x < 70; ++x) {
                const double depth = (radius_mm - glm::length(centre_of_voxel_mm(grid, {x, y, z}))) / 0.1;
                volume.hu.push_back(static_cast<std::int16_t>(
                    std::lround(threshold_hu + 300.0 * std::clamp(depth, -2.0, 2.0))));
            }
    return volume;
}

TEST(BoneFromHu, VolumeOfASphereIsRightToATwentiethOfAPercent) {
    for (const double radius_mm : {1.3, 2.5}) {
        const Bone bone = bone_from_hu(blurred_sphere(radius_mm), threshold_hu, default_stiffness_relation());
        const double exact = 4.0 / 3.0 * 3.14159265358979 * radius_mm * radius_mm * radius_mm;
        // A cover that falls straight from 1 to 0 over a voxel's width h, as the burr's does too, adds
        // (h / R)^2 / 4 to a sphere, since there is more room outside the surface than inside.
        const double of_the_cover = 1.0 + 0.25 * (0.1 / radius_mm) * (0.1 / radius_mm);
        EXPECT_NEAR(bone_volume_mm3(bone) / exact, of_the_cover, 0.0005) << radius_mm;
    }
}

TEST(BoneFromHu, ASharpStepGivesWholeVoxelsAndOneStiffnessForAll) {
    const Grid grid{.size_voxels = {20, 20, 20}};
    HuVolume volume{.grid = grid, .hu = std::vector<std::int16_t>(8000, -1000), .tissue = {}};
    std::fill_n(volume.hu.begin(), 4000, std::int16_t{1600});
    const Bone bone = bone_from_hu(volume, threshold_hu, default_stiffness_relation());
    EXPECT_TRUE(bone.content().stiffness.empty()) << "homogeneous: no channel";
    EXPECT_TRUE(bone.content().tissue.empty());
    EXPECT_EQ(bone.fraction_at({10, 10, 9}), 255);
    EXPECT_EQ(bone.fraction_at({10, 10, 10}), 0);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({0, 0, 0}), 1.0);
    EXPECT_DOUBLE_EQ(bone_volume_mm3(bone), 4.0);
}

TEST(BoneFromHu, ATissueWithAStiffnessOfItsOwnHasItWhateverItsCtNumbers) {
    const Grid grid{.size_voxels = {16, 16, 16}};
    HuVolume volume{.grid = grid,
                    .hu = std::vector<std::int16_t>(4096, 1600),
                    .tissue = std::vector<std::uint8_t>(4096, 3)};
    std::fill_n(volume.tissue.begin(), 256 * 8, std::uint8_t{4});
    StiffnessRelation relation = default_stiffness_relation();
    relation.tissues = {{4, 3.0}};
    const Bone bone = bone_from_hu(volume, threshold_hu, relation);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({5, 5, 2}), 3.0);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({5, 5, 12}), 1.0);
    volume.tissue.clear();
    EXPECT_DOUBLE_EQ(bone_from_hu(volume, threshold_hu, relation).stiffness_at({5, 5, 2}), 1.0)
        << "no labels, no tissues";
}

TEST(BoneFromHu, ATissueWithAFactorIsSoMuchStifferThanItsCtNumbersSay) {
    const Grid grid{.size_voxels = {16, 16, 16}};
    HuVolume volume{.grid = grid,
                    .hu = std::vector<std::int16_t>(4096, 1600),
                    .tissue = std::vector<std::uint8_t>(4096, 3)};
    std::fill_n(volume.tissue.begin(), 256 * 8, std::uint8_t{4});
    StiffnessRelation relation = default_stiffness_relation();
    relation.factors = {{4, 0.5}};
    const Bone bone = bone_from_hu(volume, threshold_hu, relation);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({5, 5, 2}), 0.5);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({5, 5, 12}), 1.0);
    relation.factors = {{4, 100.0}};
    EXPECT_DOUBLE_EQ(bone_from_hu(volume, threshold_hu, relation).stiffness_at({5, 5, 2}),
                     largest_relative_stiffness)
        << "what a voxel can say";
}

TEST(BoneFromHu, AMixedVoxelOnTheSurfaceIsAsStiffAsTheBoneBesideItAndBearsItsLabel) {
    const Grid grid{.size_voxels = {16, 16, 16}};
    HuVolume volume{.grid = grid,
                    .hu = std::vector<std::int16_t>(4096, -1000),
                    .tissue = std::vector<std::uint8_t>(4096, 0)};
    std::fill_n(volume.hu.begin(), 256 * 8, std::int16_t{1600});
    std::fill_n(volume.tissue.begin(), 256 * 8, std::uint8_t{3});
    std::fill_n(volume.hu.begin() + 256 * 8, 256, std::int16_t{400});  // half air
    const Bone bone = bone_from_hu(volume, threshold_hu, default_stiffness_relation());
    EXPECT_GT(bone.fraction_at({8, 8, 8}), 0);
    EXPECT_LT(bone.fraction_at({8, 8, 8}), 255);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({8, 8, 8}), 1.0);
    EXPECT_EQ(bone.tissue_at({8, 8, 8}), 3);
}

/// A block with a surface at z = 0, bone below: the volume in it of the tissue given by `is_tissue(place)`,
/// mm^3, and of all bone.
template <typename IsTissue>
std::vector<double> volumes_in_block_mm3(const IsTissue& is_tissue) {
    const Grid grid{.size_voxels = {101, 99, 97}, .spacing_mm = 0.1, .origin_mm = {-5.03, -4.87, -7.26}};
    HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
    for (int z = 0; z < grid.size_voxels.z; ++z)
        for (int y = 0; y < grid.size_voxels.y; ++y)
            for (int x = 0; x < grid.size_voxels.x; ++x) {
                const glm::dvec3 at_mm = centre_of_voxel_mm(grid, {x, y, z});
                const double depth = std::clamp(-at_mm.z / 0.1, -2.0, 2.0);
                volume.hu.push_back(static_cast<std::int16_t>(std::lround(threshold_hu + 300.0 * depth)));
                volume.tissue.push_back(is_tissue(at_mm) ? 7 : 0);
            }
    std::vector<double> mm3 =
        bone_volume_by_tissue_mm3(bone_from_hu(volume, threshold_hu, default_stiffness_relation()));
    mm3.resize(256);
    return {mm3[7], mm3[7] + mm3[0]};
}

constexpr double pi = 3.14159265358979;

double from_line_mm(const glm::dvec3& at_mm, const glm::dvec3& through_mm, const glm::dvec3& along) {
    return glm::length(glm::cross(at_mm - through_mm, along));
}

TEST(BoneFromHu, ATissueInBoneIsAsFatAsItsLabels) {
    const auto ball = [](const glm::dvec3& at_mm) {
        return glm::length(at_mm - glm::dvec3(0, 0, -3.5)) < 3.0;
    };
    EXPECT_NEAR(volumes_in_block_mm3(ball)[0], 36.0 * pi, 0.01 * 36.0 * pi);
    const auto rod = [](const glm::dvec3& at_mm) {
        return std::abs(at_mm.x) < 4.0 && from_line_mm(at_mm, {0.0, 0.0, -3.5}, {1.0, 0.0, 0.0}) < 1.0;
    };
    EXPECT_NEAR(volumes_in_block_mm3(rod)[0], 8.0 * pi, 0.01 * 8.0 * pi);
}

TEST(BoneFromHu, ATissueThatComesToTheSurfaceHasOfItWhatLiesOverIt) {
    // Labelled up to the surface, as a segmentation of bone is: bone in the surface's voxels keeps its own
    // label, and takes none from its neighbours.
    const auto half_ball = [](const glm::dvec3& at_mm) { return at_mm.z < 0.0 && glm::length(at_mm) < 3.0; };
    EXPECT_NEAR(volumes_in_block_mm3(half_ball)[0], 18.0 * pi, 0.01 * 18.0 * pi);
    const auto rod = [](const glm::dvec3& at_mm) {
        return at_mm.z < 0.0 && from_line_mm(at_mm, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}) < 1.0;
    };
    const double rod_mm3 = pi * 7.31;  // to the lowest voxels' faces
    EXPECT_NEAR(volumes_in_block_mm3(rod)[0], rod_mm3, 0.01 * rod_mm3);
    // One that lies on the bone, as a nerve in a groove that has no depth, takes none of it.
    const auto above = [](const glm::dvec3& at_mm) { return at_mm.z > 0.11 && at_mm.z < 2.0; };
    EXPECT_EQ(volumes_in_block_mm3(above)[0], 0.0);
}

TEST(BoneFromHu, RefusesAThresholdThatIsNoNumber) {
    const HuVolume volume = blurred_sphere(1.0);
    for (const double threshold : {std::nan(""), HUGE_VAL, -HUGE_VAL})
        EXPECT_THROW((void)bone_from_hu(volume, threshold, default_stiffness_relation()),
                     std::invalid_argument);
}

}  // namespace
}  // namespace osteomill
