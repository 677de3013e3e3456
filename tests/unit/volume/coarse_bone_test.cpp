#include "render_client/volume/textures/coarse_bone.h"

#include <gtest/gtest.h>

#include "studies/render/made_bone.h"

namespace osteomill::coarse_bone_test {
namespace {

const Grid grid{.size_voxels = {67, 50, 35}, .origin_mm = {0.05, 0.05, 0.05}};

Bone ball() {
    return made_bone(
        grid, [](const glm::dvec3& p) { return 1.4 - glm::length(p - glm::dvec3(3.1, 2.4, 1.8)); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.x > 3.0 ? 1 : 2); });
}

int mean_fraction(const Bone& fine, const glm::ivec3& coarse_voxel, int coarsening) {
    int sum = 0;
    for (int z = 0; z < coarsening; ++z)
        for (int y = 0; y < coarsening; ++y)
            for (int x = 0; x < coarsening; ++x)
                sum += fine.fraction_at(coarse_voxel * coarsening + glm::ivec3(x, y, z));
    const int count = coarsening * coarsening * coarsening;
    return (sum + count / 2) / count;
}

void expect_means(const Bone& fine, const Bone& coarse, int coarsening) {
    const glm::ivec3 size = coarse.grid().size_voxels;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                ASSERT_EQ(coarse.fraction_at({x, y, z}), mean_fraction(fine, {x, y, z}, coarsening));
}

TEST(CoarseBone, HoldsTheMeanOfTheVoxelsThatEachOfItsVoxelsStandsFor) {
    const Bone fine = ball();
    for (const int coarsening : {2, 4, 8}) {
        const CoarseBone coarse(fine, coarsening);
        expect_means(fine, coarse.bone(), coarsening);
    }
}

TEST(CoarseBone, LiesWhereTheFineBoneLies) {
    const Bone fine = ball();
    const CoarseBone coarse(fine, 4);
    EXPECT_NEAR(bone_volume_mm3(coarse.bone()), bone_volume_mm3(fine), 0.01 * bone_volume_mm3(fine));
    const Grid of_coarse = coarse.bone().grid();
    const glm::dvec3 first_four_mm =
        0.5 * (centre_of_voxel_mm(grid, {0, 0, 0}) + centre_of_voxel_mm(grid, {3, 3, 3}));
    EXPECT_NEAR(glm::length(of_coarse.origin_mm - first_four_mm), 0.0, 1e-12);
}

TEST(CoarseBone, FollowsCarvingAndUndoing) {
    Bone fine = ball();
    const Bone whole = fine;
    CoarseBone coarse(fine, 2);
    const auto changes = carve_sphere(fine, {3.1, 2.0, 2.8}, 0.9);
    const auto changed = coarse.update(fine, changes);
    EXPECT_FALSE(changed.empty());
    EXPECT_LE(changed.size(), changes.size());
    expect_means(fine, coarse.bone(), 2);
    coarse.update(whole, changes);
    expect_means(whole, coarse.bone(), 2);
}

TEST(CoarseBone, TakesTheTissueOfTheFullestVoxel) {
    const CoarseBone coarse(ball(), 2);
    EXPECT_EQ(coarse.bone().tissue_at({17, 12, 9}), 1);
    EXPECT_EQ(coarse.bone().tissue_at({12, 12, 9}), 2);
}

}  // namespace
}  // namespace osteomill::coarse_bone_test
