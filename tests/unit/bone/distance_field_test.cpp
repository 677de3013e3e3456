#include "common/bone/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace osteomill {
namespace {

Grid grid_of(double spacing_mm) {
    return {.size_voxels = {50, 40, 36}, .spacing_mm = spacing_mm, .origin_mm = {-3.0, 10.0, 0.7}};
}

struct Structure {
    StructureMask mask;
    std::vector<glm::ivec3> voxels;
};

Structure structure_where(const Grid& grid, const std::function<bool(const glm::ivec3&)>& belongs) {
    const glm::ivec3 size = size_in_bricks(grid);
    std::vector<StructureBrick> bricks;
    std::vector<glm::ivec3> voxels;
    for (BrickIndex brick = 0; brick < static_cast<BrickIndex>(size.x * size.y * size.z); ++brick) {
        bricks.push_back({brick, {}});
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::ivec3 voxel = brick_edge_voxels * brick_position(size, brick) + voxel_in_brick(offset);
            if (!contains(grid, voxel) || !belongs(voxel)) continue;
            bricks.back().voxels.set(offset);
            voxels.push_back(voxel);
        }
    }
    return {StructureMask(grid, std::move(bricks)), std::move(voxels)};
}

/// From the nearest of the voxels' cubes.
double brute_force_mm(const Structure& structure, const glm::dvec3& position_mm) {
    const Grid& grid = structure.mask.grid();
    double least = std::numeric_limits<double>::infinity();
    for (const glm::ivec3& voxel : structure.voxels) {
        const glm::dvec3 apart = glm::abs(position_mm - centre_of_voxel_mm(grid, voxel));
        least = std::min(least, glm::length(glm::max(apart - 0.5 * grid.spacing_mm, glm::dvec3(0.0))));
    }
    return least;
}

/// At voxel centres exact; at points anywhere, also outside the grid, within `most_error_voxels`.
void expect_distances(const Structure& structure, double reach_mm, double most_error_voxels) {
    const Grid& grid = structure.mask.grid();
    const DistanceField field(structure.mask, reach_mm);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-0.2, 1.2);
    for (int i = 0; i < 1500; ++i) {
        const glm::dvec3 at(anywhere(random), anywhere(random), anywhere(random));
        const bool on_centre = i % 2 == 0;
        const glm::dvec3 place = at * glm::dvec3(grid.size_voxels);
        const glm::dvec3 position_mm =
            grid.origin_mm + grid.spacing_mm * (on_centre ? glm::round(place) : place);
        const double expected_mm = brute_force_mm(structure, position_mm);
        const std::optional<float> found_mm = field.distance_mm(position_mm);
        const double tolerance_mm = on_centre ? 1e-4 : most_error_voxels * grid.spacing_mm;
        if (!found_mm) {
            EXPECT_GT(expected_mm, field.reach_mm() - tolerance_mm);
            continue;
        }
        EXPECT_LE(*found_mm, field.reach_mm());
        EXPECT_NEAR(*found_mm, expected_mm, tolerance_mm);
        if (expected_mm == 0.0) {
            EXPECT_EQ(*found_mm, 0.0F);
        }
    }
}

class DistanceFieldOf : public testing::TestWithParam<double> {};

TEST_P(DistanceFieldOf, OneVoxelIsThatFromItsCube) {
    expect_distances(
        structure_where(grid_of(GetParam()), [](const glm::ivec3& v) { return v == glm::ivec3(16, 31, 20); }),
        14.0 * GetParam(), 0.5);
}

TEST_P(DistanceFieldOf, AThinSheetIsThatFromItsFaces) {
    expect_distances(structure_where(grid_of(GetParam()), [](const glm::ivec3& v) { return v.y == 15; }),
                     10.0 * GetParam(), 0.5);
    expect_distances(
        structure_where(grid_of(GetParam()), [](const glm::ivec3& v) { return v.x + v.y + v.z == 60; }),
        9.0 * GetParam(), 0.5);
}

TEST_P(DistanceFieldOf, AWindingTubeIsWithinHalfAVoxel) {
    expect_distances(structure_where(grid_of(GetParam()),
                                     [](const glm::ivec3& v) {
                                         return std::hypot(v.x - 25.0 - 8.0 * std::sin(0.2 * v.z),
                                                           v.y - 20.0 - 5.0 * std::cos(0.2 * v.z)) < 4.0;
                                     }),
                     20.0 * GetParam(), 0.5);
}

TEST_P(DistanceFieldOf, RandomBallsIsWithinHalfAVoxel) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::vector<glm::dvec4> balls;
    for (int i = 0; i < 12; ++i)
        balls.emplace_back(50.0 * part(random), 40.0 * part(random), 36.0 * part(random),
                           1.0 + 4.0 * part(random));
    expect_distances(structure_where(grid_of(GetParam()),
                                     [&](const glm::ivec3& v) {
                                         return std::ranges::any_of(balls, [&](const glm::dvec4& ball) {
                                             return glm::distance(glm::dvec3(v), glm::dvec3(ball)) < ball.w;
                                         });
                                     }),
                     11.0 * GetParam(), 0.5);
}

TEST_P(DistanceFieldOf, RandomVoxelsIsWithinHalfAVoxel) {
    for (const double share : {0.0005, 0.01}) {
        std::mt19937 random(5);
        std::bernoulli_distribution taken(share);
        expect_distances(
            structure_where(grid_of(GetParam()), [&](const glm::ivec3&) { return taken(random); }),
            6.0 * GetParam(), 0.5);
    }
}

INSTANTIATE_TEST_SUITE_P(VoxelSizes, DistanceFieldOf, testing::Values(0.05, 0.1, 0.31));

TEST(DistanceField, OfNothingHasEverythingOutOfReach) {
    const Grid grid = grid_of(0.1);
    EXPECT_FALSE(DistanceField(StructureMask(grid, {}), 2.0).distance_mm(grid.origin_mm));
    EXPECT_FALSE(DistanceField().distance_mm({0.0, 0.0, 0.0}));
}

TEST(DistanceField, AnswersNothingForPlacesThatAreNone) {
    const Structure structure =
        structure_where(grid_of(0.1), [](const glm::ivec3& v) { return v == glm::ivec3(20, 20, 20); });
    const DistanceField field(structure.mask, 1.0);
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(field.distance_mm({none, 12.0, 2.7}));
    EXPECT_FALSE(field.distance_mm({1e300, -1e300, 0.0}));
    EXPECT_THROW(DistanceField(structure.mask, 0.0), std::invalid_argument);
    EXPECT_THROW(DistanceField(structure.mask, none), std::invalid_argument);
}

TEST(DistanceField, CutsAReachDownThatItsNumbersDoNotHold) {
    const Structure structure =
        structure_where(grid_of(0.1), [](const glm::ivec3& v) { return v == glm::ivec3(20, 20, 20); });
    const DistanceField field(structure.mask, 100.0);
    EXPECT_DOUBLE_EQ(field.reach_mm(), 12.5);
    const glm::dvec3 centre_mm = centre_of_voxel_mm(structure.mask.grid(), {20, 20, 20});
    EXPECT_NEAR(*field.distance_mm(centre_mm + glm::dvec3(7.2, 7.2, 7.2)), std::sqrt(3.0) * 7.15, 0.01);
}

// A band costs what it spans, whatever the grid round it.
TEST(DistanceField, CostsMemoryNearTheStructureOnly) {
    Grid grid{.size_voxels = {2000, 2000, 2000}, .spacing_mm = 0.1, .origin_mm = {}};
    const glm::ivec3 size = size_in_bricks(grid);
    std::vector<StructureBrick> nerve;  // 1 mm thick, 30 mm long
    for (int z = 40; z < 59; ++z) {
        VoxelMask voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::ivec3 v = voxel_in_brick(offset);
            if (std::hypot(v.x - 7.5, v.y - 7.5) < 5.0) voxels.set(offset);
        }
        nerve.push_back({brick_index(size, {50, 50, z}), voxels});
    }
    const StructureMask mask(grid, nerve);
    const DistanceField field(mask, 5.0);
    EXPECT_LT(mask.memory_bytes(), 12'000U);
    EXPECT_LT(field.memory_bytes(), 20'000'000U);
}

TEST(DistanceField, OfAStructureThatIsTooLargeIsRefused) {
    const Grid huge{.size_voxels = {4096, 4096, 4096}, .spacing_mm = 0.1, .origin_mm = {}};
    std::vector<StructureBrick> bricks;
    for (BrickIndex brick = 0; brick < 256 * 256 * 256; brick += 97)
        bricks.push_back({brick, VoxelMask().set(7)});
    EXPECT_THROW(DistanceField(StructureMask(huge, std::move(bricks)), 1.0), std::length_error);
}

}  // namespace
}  // namespace osteomill
