#include "simulation/force_models/ball_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "tests/support/block.h"

namespace osteomill::ball_rows_test {
namespace {

using testing::make_block;

TEST(BallRows, ReachEveryVoxelThatTheBallCoversAndNoneTwice) {
    const Bone bone = make_block({0.0, 0.0, 0.0}, {4.0, 4.0, 4.0}, 0.1);
    for (const Ball& ball : {Ball{{19.3, 17.8, 21.1}, 7.4}, Ball{{1.0, 38.5, 15.9}, 5.0},
                             Ball{{-3.0, 20.0, 20.0}, 4.0}, Ball{{16.2, 16.0, 16.0}, 0.3}}) {
        std::set<std::pair<std::int32_t, std::size_t>> seen;
        double covered = 0.0;
        visit_immersed(
            bone, ball,
            [&](const glm::dvec3&, double cover, double fraction, std::size_t offset, std::int32_t slot) {
                EXPECT_TRUE(seen.emplace(slot, offset).second);
                EXPECT_EQ(fraction, 1.0);
                covered += cover;
            });
        double expected = 0.0;
        std::size_t count = 0;
        for (int z = 0; z < 40; ++z)
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 40; ++x) {
                    const double distance = glm::distance(glm::dvec3(x, y, z), ball.centre);
                    const double cover = std::clamp(0.5 + ball.radius - distance, 0.0, 1.0);
                    count += cover > 0.0 ? 1 : 0;
                    expected += cover;
                }
        EXPECT_EQ(seen.size(), count);
        EXPECT_NEAR(covered, expected, 1e-9 * expected);
    }
}

TEST(BallRows, SkipWhatHoldsNoBone) {
    Bone bone = make_block({0.0, 0.0, 0.0}, {1.6, 1.6, 1.6}, 0.1);
    for (std::uint8_t& fraction : bone.fractions(0)) fraction = 0;
    bone.fractions(0)[offset_in_brick({8, 7, 6})] = 255;
    int rows = 0;
    visit_rows(bone, {{8.0, 8.0, 8.0}, 5.0}, [&](const BallRow& row) {
        ++rows;
        EXPECT_EQ(row.first.y, 7);
        EXPECT_EQ(row.first.z, 6);
        EXPECT_LE(row.first.x, 8);
        EXPECT_GT(row.first.x + row.count, 8);
    });
    EXPECT_EQ(rows, 1);
}

TEST(BallRows, AreNoneFarFromTheGrid) {
    const Bone bone = make_block({0.0, 0.0, 0.0}, {1.6, 1.6, 1.6}, 0.1);
    for (const double far : {-1e12, -30.0, 30.0, 1e12})
        visit_rows(bone, {{far, 8.0, 8.0}, 5.0}, [&](const BallRow&) { ADD_FAILURE() << far; });
}

}  // namespace
}  // namespace osteomill::ball_rows_test
