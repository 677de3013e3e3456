#include "analysis/surface/surface_mesh.h"

#include <gmock/gmock.h>

#include <functional>
#include <numbers>
#include <random>

#include "tests/support/block.h"
#include "tests/support/closed_surface.h"

namespace osteomill {
namespace {

/// Places as in a scan of a head, where 32-bit numbers are coarse.
constexpr glm::dvec3 far_origin_mm{-161.37, 1024.43, 1873.91};

Bone bone_of(const Grid& grid, const std::function<int(const glm::ivec3&)>& fraction) {
    return filled(BoneBuilder::homogeneous(grid, 1.0, false), grid, [&](const glm::ivec3& voxel) {
        return VoxelValues{.fraction = static_cast<std::uint8_t>(fraction(voxel))};
    });
}

void expect_closed(const SurfaceMesh& mesh) {
    EXPECT_EQ(testing::open_edges(mesh.triangles), 0U);
    EXPECT_EQ(testing::open_edges(testing::welded(mesh.points_mm, mesh.triangles)), 0U) << "by place";
}

double enclosed_mm3(const SurfaceMesh& mesh) {
    return testing::enclosed_mm3(mesh.points_mm, mesh.triangles);
}

struct Extent {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};
};

Extent extent_of(const SurfaceMesh& mesh) {
    Extent extent;
    for (const glm::vec3& point : mesh.points_mm) {
        extent.low = glm::min(extent.low, point);
        extent.high = glm::max(extent.high, point);
    }
    return extent;
}

class SurfaceOfSphere : public ::testing::TestWithParam<double> {};

TEST_P(SurfaceOfSphere, LiesWithinATenthOfAVoxelInTheMean) {
    constexpr double spacing_mm = 0.1;
    const double radius_mm = GetParam();
    const glm::dvec3 centre_mm(0.013, -0.027, 0.041);
    const Bone bone = testing::make_block(
        glm::dvec3(-radius_mm - 0.3), glm::dvec3(radius_mm + 0.3), spacing_mm,
        [&](const glm::dvec3& place_mm) { return radius_mm - glm::distance(place_mm, centre_mm); });
    const SurfaceMesh mesh = surface_of(bone);
    expect_closed(mesh);
    double off_mm = 0.0;
    for (const glm::vec3& point : mesh.points_mm)
        off_mm += std::abs(glm::distance(glm::dvec3(point), centre_mm) - radius_mm);
    EXPECT_LT(off_mm / static_cast<double>(mesh.points_mm.size()), 0.1 * spacing_mm);
    const double volume_mm3 = 4.0 / 3.0 * std::numbers::pi * radius_mm * radius_mm * radius_mm;
    EXPECT_NEAR(enclosed_mm3(mesh), volume_mm3, 0.3 * spacing_mm / radius_mm * volume_mm3)
        << "0.1 voxels of the area";
    for (const auto& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.points_mm[triangle[0]]);
        const glm::dvec3 b(mesh.points_mm[triangle[1]]);
        const glm::dvec3 c(mesh.points_mm[triangle[2]]);
        ASSERT_GT(glm::dot(glm::cross(b - a, c - a), (a + b + c) / 3.0 - centre_mm), 0.0);
    }
    const std::vector<glm::vec3> normals = vertex_normals(mesh);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 outward = glm::normalize(glm::dvec3(mesh.points_mm[i]) - centre_mm);
        ASSERT_GT(glm::dot(glm::dvec3(normals[i]), outward), 0.9);
    }
}

INSTANTIATE_TEST_SUITE_P(Radii, SurfaceOfSphere, ::testing::Values(0.5, 1.5, 4.0));

TEST(Surface, OfABlockThatFillsItsGridIsItsFaces) {
    const Bone bone = testing::make_block({1.0, 2.0, 3.0}, {3.0, 4.4, 5.7}, 0.1);
    const SurfaceMesh mesh = surface_of(bone);
    expect_closed(mesh);
    const auto [low, high] = extent_of(mesh);
    EXPECT_LT(glm::distance(low, {1.0F, 2.0F, 3.0F}), 1e-5F);
    EXPECT_LT(glm::distance(high, {3.0F, 4.4F, 5.7F}), 1e-5F);
    // Along an edge a vertex lies a quarter of a voxel inside of two faces: a quarter of a voxel's section
    // goes.
    const double cut_mm3 = 0.25 * 0.01 * 4.0 * (2.0 + 2.4 + 2.7);
    EXPECT_NEAR(enclosed_mm3(mesh), 2.0 * 2.4 * 2.7 - cut_mm3, 0.1 * cut_mm3);
}

TEST(Surface, OfAWallOfOneVoxelIsAVoxelThick) {
    const Grid grid{.size_voxels = {24, 24, 24}, .spacing_mm = 0.1, .origin_mm = far_origin_mm};
    const SurfaceMesh mesh =
        surface_of(bone_of(grid, [](const glm::ivec3& v) { return v.y == 15 ? 255 : 0; }));
    expect_closed(mesh);
    const auto [low, high] = extent_of(mesh);
    EXPECT_NEAR(high.y - low.y, 0.1, 1e-3);
}

TEST(Surface, OfAHollowBlockHasNormalsIntoTheHollow) {
    const Grid grid{.size_voxels = {20, 20, 20}, .spacing_mm = 1.0};
    const auto within = [](const glm::ivec3& v, int low, int high) {
        return std::min({v.x, v.y, v.z}) >= low && std::max({v.x, v.y, v.z}) < high;
    };
    const Bone solid = bone_of(grid, [&](const auto& v) { return within(v, 2, 18) ? 255 : 0; });
    const Bone hollow =
        bone_of(grid, [&](const auto& v) { return within(v, 2, 18) && !within(v, 5, 15) ? 255 : 0; });
    expect_closed(surface_of(hollow));
    // Along an edge a vertex lies a quarter of a voxel inside of two faces: a quarter of a voxel's section
    // goes.
    const double cut_mm3 = 0.25 * 12.0 * 10.0;
    EXPECT_NEAR(enclosed_mm3(surface_of(solid)) - enclosed_mm3(surface_of(hollow)), 1000.0 - cut_mm3,
                0.1 * cut_mm3);
}

TEST(Surface, OfLoneVoxelsOfEveryFractionIsClosed) {
    for (int fraction = 1; fraction < 256; ++fraction) {
        const Grid grid{.size_voxels = {3, 3, 3}, .spacing_mm = 0.1, .origin_mm = far_origin_mm};
        const SurfaceMesh mesh =
            surface_of(bone_of(grid, [&](const auto& v) { return v == glm::ivec3(2, 0, 1) ? fraction : 0; }));
        EXPECT_EQ(mesh.triangles.empty(), fraction < 128) << fraction;
        expect_closed(mesh);
        EXPECT_EQ(enclosed_mm3(mesh) > 0.0, fraction >= 128) << fraction;
    }
}

TEST(Surface, OfFractionsAtRandomIsClosed) {
    std::mt19937 random(7);
    using Draw = std::function<int()>;
    const std::vector<Draw> draws{
        [&] { return static_cast<int>(random() % 256); }, [&] { return random() % 2 == 0 ? 255 : 0; },
        [&] { return random() % 9 == 0 ? 255 : 0; }, [&] { return random() % 9 == 0 ? 0 : 255; },
        [&] { return 120 + static_cast<int>(random() % 16); }};
    for (std::size_t draw = 0; draw < draws.size(); ++draw) {
        SCOPED_TRACE(draw);
        const Grid grid{.size_voxels = {35, 18, 33}, .spacing_mm = 0.1, .origin_mm = far_origin_mm};
        const SurfaceMesh mesh = surface_of(bone_of(grid, [&](const auto&) { return draws[draw](); }));
        EXPECT_GT(mesh.triangles.size(), 10000U);
        expect_closed(mesh);
    }
}

TEST(Surface, DoesNotDependOnWhereBricksMeet) {
    double first_mm3 = 0.0;
    std::size_t first_triangles = 0;
    for (int shift = 0; shift < brick_edge_voxels; ++shift) {
        const Grid grid{.size_voxels = {40, 40, 40}, .spacing_mm = 1.0};
        const SurfaceMesh mesh = surface_of(bone_of(grid, [&](const glm::ivec3& v) {
            const glm::dvec3 place(v - shift);
            const double depth = 8.0 - glm::distance(place, glm::dvec3(12.3, 11.8, 12.1));
            return static_cast<int>(std::lround(255.0 * std::clamp(0.5 + depth, 0.0, 1.0)));
        }));
        expect_closed(mesh);
        if (shift == 0) {
            first_mm3 = enclosed_mm3(mesh);
            first_triangles = mesh.triangles.size();
        }
        EXPECT_EQ(mesh.triangles.size(), first_triangles) << shift;
        EXPECT_NEAR(enclosed_mm3(mesh), first_mm3, 1e-3) << shift;
    }
}

TEST(Surface, CostsForBricksNotForTheGridAround) {
    // Dense, this grid would be 2 TB.
    const Grid grid{.size_voxels = {20000, 20000, 5000}, .spacing_mm = 0.1, .origin_mm = {0.0, 0.0, 0.0}};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, false);
    ByteBrick whole;
    whole.fill(255);
    builder.add_brick({0, 0, 0}, whole, nullptr, nullptr);
    builder.add_brick(size_in_bricks(grid) - 2, whole, nullptr, nullptr);
    const SurfaceMesh mesh = surface_of(std::move(builder).build());
    expect_closed(mesh);
    EXPECT_LT(mesh.triangles.size(), 10000U);
    EXPECT_GT(extent_of(mesh).high.x, 1996.0F);
}

TEST(Surface, OfCoarserCellsLiesWhereTheFineOneDoes) {
    constexpr double radius_mm = 3.0;
    const glm::dvec3 centre_mm(0.013, -0.027, 0.041);
    const Bone bone = testing::make_block(
        glm::dvec3(-3.4), glm::dvec3(3.4), 0.1,
        [&](const glm::dvec3& place_mm) { return radius_mm - glm::distance(place_mm, centre_mm); });
    std::size_t triangles = surface_of(bone).triangles.size();
    for (const int voxels : {2, 3, 5}) {
        SCOPED_TRACE(voxels);
        const SurfaceMesh mesh = surface_of(bone, voxels);
        expect_closed(mesh);
        EXPECT_LT(mesh.triangles.size(), 0.8 * static_cast<double>(triangles));
        triangles = mesh.triangles.size();
        double off_mm = 0.0;
        for (const glm::vec3& point : mesh.points_mm)
            off_mm += std::abs(glm::distance(glm::dvec3(point), centre_mm) - radius_mm);
        EXPECT_LT(off_mm / static_cast<double>(mesh.points_mm.size()), 0.1 * 0.1 * voxels);
    }
    std::mt19937 random(5);
    const Grid grid{.size_voxels = {35, 18, 33}, .spacing_mm = 0.1, .origin_mm = far_origin_mm};
    expect_closed(surface_of(bone_of(grid, [&](const auto&) { return random() % 2 == 0 ? 255 : 0; }), 2));
}

TEST(Surface, OfNothingIsNothing) {
    const Grid grid{.size_voxels = {20, 20, 20}};
    const SurfaceMesh mesh = surface_of(BoneBuilder::homogeneous(grid, 1.0, false).build());
    EXPECT_TRUE(mesh.points_mm.empty());
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_TRUE(vertex_normals(mesh).empty());
}

}  // namespace
}  // namespace osteomill
