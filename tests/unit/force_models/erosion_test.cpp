#include "simulation/force_models/erosion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/block.h"
#include "tests/support/bone_variants.h"

namespace osteomill::erosion_test {
namespace {

using testing::make_block;

Bone block(double stiffness = 1.0) {
    return testing::with_stiffness(make_block({0.0, 0.0, 0.0}, {3.2, 3.2, 3.2}, 0.1), stiffness);
}

class Count final : public ErosionSink {
  public:
    void take(std::int32_t, std::size_t, int levels) noexcept override { total += levels; }
    long total = 0;
};

class Copy final : public ChangeSink {
  public:
    void push(const BrickChange& change, BrickFractions fractions) noexcept override {
        EXPECT_TRUE(apply(change, fractions, bone));
    }
    Bone bone = block();
};

class ErosionTest : public ::testing::Test {
  protected:
    Erosion erosion{8.0};
    ForgottenChanges no_changes;
    Count count;
    const Ball ball{{15.3, 16.2, 14.9}, 6.0};
    const glm::ivec3 inside{15, 16, 15};
};

TEST_F(ErosionTest, TakesTheDoseFromWhatIsFullyCovered) {
    Bone bone = block();
    erosion.erode(bone, ball, 0.2, no_changes, count);
    EXPECT_EQ(bone.fraction_at(inside), 255 - 51);
    EXPECT_EQ(bone.fraction_at({15, 16, 28}), 255) << "out of reach";
}

TEST_F(ErosionTest, IsSlowerInHarderBone) {
    Bone bone = block(2.0);
    erosion.erode(bone, ball, 0.4, no_changes, count);
    EXPECT_EQ(bone.fraction_at(inside), 255 - 51);
    Bone without_strength = block(0.0);
    Erosion(8.0).erode(without_strength, ball, 0.001, no_changes, count);
    EXPECT_EQ(without_strength.fraction_at(inside), 255 - 13) << "no faster than bone of stiffness 0.02";
}

TEST_F(ErosionTest, IsInProportionToTheCover) {
    Bone bone = block();
    erosion.erode(bone, ball, 1.0 / 255.0 * 100.0, no_changes, count);
    for (int x = 15; x < 24; ++x) {
        const glm::ivec3 voxel(x, 16, 15);
        const double cover =
            std::clamp(0.5 + ball.radius - glm::distance(glm::dvec3(voxel), ball.centre), 0.0, 1.0);
        EXPECT_EQ(bone.fraction_at(voxel), 255 - static_cast<int>(std::lround(100.0 * cover))) << voxel.x;
    }
}

TEST_F(ErosionTest, CarriesWhatFallsShortOfAStep) {
    Bone at_once = block();
    Bone bit_by_bit = block();
    erosion.erode(at_once, ball, 0.4, no_changes, count);
    const long total = count.total;
    count.total = 0;
    Erosion other(8.0);
    constexpr int steps = 2000;  // a twentieth of a code each
    for (int i = 0; i < steps; ++i) other.erode(bit_by_bit, ball, 0.4 / steps, no_changes, count);
    EXPECT_NEAR(static_cast<double>(count.total) / static_cast<double>(total), 1.0, 0.002);
    for (int x = 8; x < 24; ++x)
        EXPECT_NEAR(bit_by_bit.fraction_at({x, 16, 15}), at_once.fraction_at({x, 16, 15}), 1.0) << x;
}

TEST_F(ErosionTest, LosesNoRemainderWhenTheBurrMovesOn) {
    Bone bone = block();
    constexpr int steps = 1000;
    double covered = 0.0;
    for (int i = 0; i < steps; ++i) {
        const Ball moving{{12.0 + 8.0 * i / steps, 16.2, 14.9}, 5.0};
        erosion.erode(bone, moving, 0.2 / steps, no_changes, count);
        visit_immersed(bone, moving, [&](const glm::dvec3&, double cover, double, std::size_t, std::int32_t) {
            covered += cover * 255.0 * 0.2 / steps;
        });
    }
    EXPECT_NEAR(static_cast<double>(count.total) / covered, 1.0, 0.01);
}

TEST_F(ErosionTest, TakesNoMoreThanThereIsAndThenNothing) {
    Bone bone = block();
    erosion.erode(bone, ball, 1e9, no_changes, count);
    EXPECT_EQ(bone.fraction_at(inside), 0);
    const std::uint64_t before = checksum(bone);
    const long total = count.total;
    erosion.erode(bone, {ball.centre, ball.radius - 1.0}, 1e9, no_changes, count);
    EXPECT_EQ(checksum(bone), before);
    EXPECT_EQ(count.total, total);
}

TEST_F(ErosionTest, TellsWhoeverCopiesTheBone) {
    Bone bone = block();
    Copy copy;
    for (int i = 0; i < 20; ++i) erosion.erode(bone, {{14.0 + 0.3 * i, 16.2, 14.9}, 6.0}, 0.07, copy, count);
    EXPECT_EQ(checksum(copy.bone), checksum(bone));
    EXPECT_NE(checksum(bone), checksum(block()));
}

TEST_F(ErosionTest, OfNoDoseChangesNothing) {
    Bone bone = block();
    erosion.erode(bone, ball, 0.0, no_changes, count);
    EXPECT_EQ(count.total, 0);
}

}  // namespace
}  // namespace osteomill::erosion_test
