#include "render_client/volume/structures/structure_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/render/made_bone.h"
#include "tests/support/ball_structure.h"
#include "tests/support/closed_surface.h"

namespace osteomill::structure_surface_test {
namespace {

const Grid grid{.size_voxels = {64, 64, 64}, .spacing_mm = 0.2, .origin_mm = {-6.3, -6.3, -6.3}};

std::vector<testing::Triangle> triangles_of(const Triangles& mesh) {
    std::vector<testing::Triangle> triangles;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    return triangles;
}

TEST(StructureSurface, OfABallIsAClosedSphere) {
    const glm::dvec3 centre_mm(0.33, -0.21, 0.5);
    const StructureSurface surface =
        surface_of(testing::ball_mask(grid, centre_mm, 3.0), glm::vec3(1.0f, 0.5f, 0.0f));
    ASSERT_FALSE(surface.triangles.indices.empty());
    EXPECT_EQ(testing::open_edges(triangles_of(surface.triangles)), 0u);
    double mean_mm = 0.0;
    for (const Vertex& vertex : surface.triangles.vertices) {
        const glm::dvec3 out = surface.origin_mm + glm::dvec3(vertex.position) - centre_mm;
        EXPECT_NEAR(glm::length(out), 3.0, 0.2);
        EXPECT_GT(glm::dot(glm::normalize(out), glm::dvec3(vertex.normal)), 0.8);
        EXPECT_EQ(vertex.colour, glm::vec3(1.0f, 0.5f, 0.0f));
        mean_mm += glm::length(out);
    }
    mean_mm /= static_cast<double>(surface.triangles.vertices.size());
    EXPECT_NEAR(mean_mm, 3.0, 0.1) << "half a voxel";
}

TEST(StructureSurface, OfNothingHasNoTriangles) {
    EXPECT_TRUE(surface_of(StructureMask(grid, {}), {}).triangles.indices.empty());
}

TEST(StructureSurface, OfALargeStructureStaysSmall) {
    // A sheet of two voxels across 2000 x 2000 voxels.
    const Grid wide{.size_voxels = {2000, 2000, 32}, .spacing_mm = 0.1, .origin_mm = {}};
    const glm::ivec3 size = size_in_bricks(wide);
    VoxelMask sheet;
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
        if (const int z = voxel_in_brick(offset).z; z == 4 || z == 5) sheet.set(offset);
    std::vector<StructureBrick> bricks;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) bricks.push_back({brick_index(size, {x, y, 0}), sheet});
    const StructureSurface surface = surface_of(StructureMask(wide, std::move(bricks)), {});
    EXPECT_GT(surface.triangles.vertices.size(), 100'000u);
    EXPECT_LT(surface.triangles.vertices.size(), 2'000'000u);
    double lowest_mm = 1e9, highest_mm = -1e9;
    for (const Vertex& vertex : surface.triangles.vertices) {
        lowest_mm = std::min(lowest_mm, surface.origin_mm.z + vertex.position.z);
        highest_mm = std::max(highest_mm, surface.origin_mm.z + vertex.position.z);
    }
    EXPECT_NEAR(lowest_mm, 0.35, 0.3);
    EXPECT_NEAR(highest_mm, 0.55, 0.3);
}

TEST(StructureSurface, IsOfWhatIsNoBone) {
    const StructureMask ball = testing::ball_mask(grid, {0.0, 0.0, 0.0}, 3.0);
    // All above z = 0 is bone.
    const Bone bone = made_bone(grid, [](const glm::dvec3& place) { return place.z > 0.0 ? 1.0 : -1.0; });
    const StructureMask soft = soft_part(ball, bone);
    EXPECT_NEAR(soft.volume_mm3(), 0.5 * ball.volume_mm3(), 0.02 * ball.volume_mm3());
    EXPECT_FALSE(soft.contains(grid.size_voxels / 2 + glm::ivec3(0, 0, 3)));
    EXPECT_TRUE(soft.contains(grid.size_voxels / 2 - glm::ivec3(0, 0, 3)));
}

}  // namespace
}  // namespace osteomill::structure_surface_test
