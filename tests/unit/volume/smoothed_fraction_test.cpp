#include "render_client/volume/textures/smoothed_fraction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "studies/render/made_bone.h"

namespace osteomill::smoothed_fraction_test {
namespace {

/// Full of fractions at random, in 2 x 2 x 1 bricks of which the last is not stored.
Bone speckled() {
    std::mt19937 random(3);
    const Grid grid{.size_voxels = {32, 32, 16}};
    return made_bone(grid, [&](const glm::dvec3& p) {
        const bool in_last = p.x > 1.55 && p.y > 1.55;
        return in_last ? -1.0 : std::uniform_real_distribution(-0.05, 0.05)(random);
    });
}

/// (1, 2, 1) / 4 three times along an axis, by the binomial coefficients.
double weight(int step) {
    constexpr std::array<double, 4> by_distance{20.0, 15.0, 6.0, 1.0};
    return by_distance[static_cast<std::size_t>(std::abs(step))] / 64.0;
}

double expected(const Bone& bone, const glm::ivec3& voxel) {
    double sum = 0.0;
    for (int z = -3; z <= 3; ++z)
        for (int y = -3; y <= 3; ++y)
            for (int x = -3; x <= 3; ++x)
                if (const glm::ivec3 other = voxel + glm::ivec3(x, y, z); contains(bone.grid(), other))
                    sum += weight(x) * weight(y) * weight(z) * bone.fraction_at(other);
    return sum;
}

TEST(SmoothedFraction, IsTheBinomialMeanOfTheNeighboursInAnyBox) {
    const Bone bone = speckled();
    FractionSmoother smoother{{}};
    for (const VoxelBox& box : {VoxelBox{{0, 0, 0}, {32, 32, 16}}, VoxelBox{{-2, 5, 3}, {18, 18, 18}},
                                VoxelBox{{7, 9, 2}, {1, 1, 1}}, VoxelBox{{13, 1, 4}, {5, 30, 2}}}) {
        const auto smoothed = smoother.smooth(bone, box);
        ASSERT_EQ(smoothed.size(), box.count());
        std::size_t place = 0;
        for (int z = 0; z < box.size.z; ++z)
            for (int y = 0; y < box.size.y; ++y)
                for (int x = 0; x < box.size.x; ++x)
                    ASSERT_NEAR(smoothed[place++], expected(bone, box.first + glm::ivec3(x, y, z)), 0.52)
                        << x << " " << y << " " << z;
    }
}

TEST(SmoothedFraction, LeavesFullAndEmptyAsTheyAre) {
    const Grid grid{.size_voxels = glm::ivec3(48)};
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 2.4 - p.z; });
    FractionSmoother smoother{{}};
    EXPECT_EQ(smoother.smooth(bone, {glm::ivec3(20), glm::ivec3(1)})[0], 255);
    EXPECT_EQ(smoother.smooth(bone, {{20, 20, 30}, glm::ivec3(1)})[0], 0);
}

TEST(SmoothedFraction, CountsByOpacityWhereOneSeesThrough) {
    const Grid grid{.size_voxels = glm::ivec3(32)};
    const Bone bone = made_bone(
        grid, [](const glm::dvec3&) { return 1.0; },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.x < 1.55 ? 1 : 2); });
    const std::vector<TissueColour> tissues{{1, {200, 180, 160}, 1.0}, {2, {200, 180, 160}, 0.2}};
    FractionSmoother smoother(transfer_table(bone.content(), tissues, {}));
    EXPECT_EQ(smoother.smooth(bone, {{8, 16, 16}, glm::ivec3(1)})[0], 255);
    // Three tenths, and a fifth of the rest.
    EXPECT_NEAR(smoother.smooth(bone, {{24, 16, 16}, glm::ivec3(1)})[0], 255 * 0.44, 1.0);
}

}  // namespace
}  // namespace osteomill::smoothed_fraction_test
