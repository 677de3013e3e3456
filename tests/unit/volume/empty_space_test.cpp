#include "render_client/volume/textures/empty_space.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "studies/render/made_bone.h"

namespace osteomill::empty_space_test {
namespace {

const Grid grid{.size_voxels = {64, 48, 48}, .origin_mm = {0.05, 0.05, 0.05}};

Bone ball() {
    return made_bone(grid,
                     [](const glm::dvec3& p) { return 1.3 - glm::length(p - glm::dvec3(2.0, 2.4, 2.4)); });
}

std::uint8_t at(const EmptySpace& space, const std::vector<std::uint8_t>& map, const glm::ivec3& block) {
    return map[(static_cast<std::size_t>(block.z) * space.size_blocks().y + block.y) * space.size_blocks().x +
               block.x];
}

/// By definition: whether a voxel of the block or of the border round it is at least half full.
bool can_hold_surface(const Bone& bone, const VoxelBox& box, const glm::ivec3& block) {
    const glm::ivec3 first = box.first + (block - 1) * block_edge_voxels - 1;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 6; ++x)
                if (bone.fraction_at(first + glm::ivec3(x, y, z)) >= 128) return true;
    return false;
}

template <typename Visit>
void for_each_block(const EmptySpace& space, Visit visit) {
    for (int z = 0; z < space.size_blocks().z; ++z)
        for (int y = 0; y < space.size_blocks().y; ++y)
            for (int x = 0; x < space.size_blocks().x; ++x) visit(glm::ivec3(x, y, z));
}

TEST(EmptySpace, IsTheChessboardDistanceToTheNearestBlockThatCanHoldSurface) {
    const Bone bone = ball();
    const VoxelBox box = stored_box(bone.content());
    const EmptySpace space(bone, box);
    std::vector<glm::ivec3> occupied;
    for_each_block(space, [&](const glm::ivec3& block) {
        if (can_hold_surface(bone, box, block)) occupied.push_back(block);
    });
    ASSERT_FALSE(occupied.empty());
    for_each_block(space, [&](const glm::ivec3& block) {
        int nearest = 255;
        for (const glm::ivec3& other : occupied) {
            const glm::ivec3 apart = glm::abs(block - other);
            nearest = std::min(nearest, std::max({apart.x, apart.y, apart.z}));
        }
        ASSERT_EQ(at(space, space.distance(), block), nearest);
    });
}

TEST(EmptySpace, NeverPromisesEmptinessThatIsNotThereWhileBoneIsCarved) {
    Bone bone = ball();
    const VoxelBox box = stored_box(bone.content());
    EmptySpace space(bone, box);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place_mm(0.5, 4.3);
    for (int cut = 0; cut < 12; ++cut) {
        const glm::dvec3 centre(place_mm(random), place_mm(random), place_mm(random));
        space.update(bone, carve_sphere(bone, centre, 0.7));
    }
    const EmptySpace fresh(bone, box);
    EXPECT_EQ(space.mean_fraction(), fresh.mean_fraction());
    for_each_block(space, [&](const glm::ivec3& block) {
        const int kept = at(space, space.distance(), block), exact = at(fresh, fresh.distance(), block);
        ASSERT_LE(kept, exact);
        ASSERT_EQ(kept == 0, exact == 0);
    });
}

TEST(EmptySpace, ReportsEveryBlockThatAnUpdateChanged) {
    Bone bone = ball();
    const VoxelBox box = stored_box(bone.content());
    EmptySpace space(bone, box);
    const EmptySpace before = space;
    const auto reported = space.update(bone, carve_sphere(bone, {2.0, 2.4, 3.6}, 0.6));
    for_each_block(space, [&](const glm::ivec3& block) {
        if (at(space, space.distance(), block) == at(before, before.distance(), block) &&
            at(space, space.mean_fraction(), block) == at(before, before.mean_fraction(), block))
            return;
        const bool covered = std::any_of(reported.begin(), reported.end(), [&](const VoxelBox& blocks) {
            return contains(Grid{.size_voxels = blocks.size}, block - blocks.first);
        });
        EXPECT_TRUE(covered);
    });
}

// Undo, or a recording played backwards, restores milled bone.
TEST(EmptySpace, FollowsBoneThatComesBack) {
    Bone bone = ball();
    const Bone whole = bone;
    const VoxelBox box = stored_box(bone.content());
    const auto carved = carve_sphere(bone, {2.0, 2.4, 2.4}, 0.9);
    // Built while carved, its distances span the cavity; updated, they have to come down again.
    EmptySpace built_carved(bone, box);
    EmptySpace updated(whole, box);
    updated.update(bone, carved);
    bone = whole;
    built_carved.update(bone, carved);
    updated.update(bone, carved);
    const EmptySpace fresh(whole, box);
    EXPECT_EQ(built_carved.distance(), fresh.distance());
    EXPECT_EQ(updated.distance(), fresh.distance());
    EXPECT_EQ(built_carved.mean_fraction(), fresh.mean_fraction());
}

}  // namespace
}  // namespace osteomill::empty_space_test
