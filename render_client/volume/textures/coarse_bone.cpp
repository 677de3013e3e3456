#include "render_client/volume/textures/coarse_bone.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "common/bone/brick_change.h"

namespace osteomill {

namespace {

glm::ivec3 coarse_brick_of(const BoneContent& fine, BrickIndex brick, int coarsening) {
    return brick_position(fine.size_bricks, brick) / coarsening;
}

/// Calls visit(first fine offset, coarse offset) for the coarse voxels that a fine brick covers.
template <typename Visit>
void for_each_coarse_voxel(const glm::ivec3& fine_brick, int coarsening, Visit visit) {
    const glm::ivec3 first = fine_brick * brick_edge_voxels / coarsening;
    const int edge = brick_edge_voxels / coarsening;
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const glm::ivec3 voxel(x, y, z);
                visit(voxel * coarsening, offset_in_brick(first + voxel));
            }
}

/// Calls visit(fine offset) for the voxels of one coarse voxel; all of them lie in one fine brick.
template <typename Visit>
void for_each_fine_voxel(const glm::ivec3& first, int coarsening, Visit visit) {
    for (int z = 0; z < coarsening; ++z)
        for (int y = 0; y < coarsening; ++y)
            for (int x = 0; x < coarsening; ++x) visit(offset_in_brick(first + glm::ivec3(x, y, z)));
}

void average_fractions(const Bone& fine, const glm::ivec3& fine_brick, std::int32_t fine_slot, int coarsening,
                       std::span<std::uint8_t, brick_voxel_count> coarse) {
    const auto fractions = fine.fractions(fine_slot);
    const int count = coarsening * coarsening * coarsening;
    for_each_coarse_voxel(fine_brick, coarsening, [&](const glm::ivec3& first, std::size_t offset) {
        int sum = 0;
        for_each_fine_voxel(first, coarsening, [&](std::size_t voxel) { sum += fractions[voxel]; });
        coarse[offset] = static_cast<std::uint8_t>((sum + count / 2) / count);
    });
}

void pick_codes(const Bone& fine, const glm::ivec3& fine_brick, std::int32_t fine_slot, int coarsening,
                const ByteBrick& codes, ByteBrick& coarse) {
    const auto fractions = fine.fractions(fine_slot);
    for_each_coarse_voxel(fine_brick, coarsening, [&](const glm::ivec3& first, std::size_t offset) {
        std::size_t fullest = offset_in_brick(first);
        for_each_fine_voxel(first, coarsening, [&](std::size_t voxel) {
            const auto rank = [&](std::size_t of) { return std::pair(codes[of] != 0, fractions[of]); };
            if (rank(voxel) > rank(fullest)) fullest = voxel;
        });
        coarse[offset] = codes[fullest];
    });
}

}  // namespace

Grid coarse_grid(const Grid& grid, int coarsening) {
    // The first coarse voxel's centre is that of the fine voxels it stands for.
    return {.size_voxels = (grid.size_voxels + (coarsening - 1)) / coarsening,
            .spacing_mm = grid.spacing_mm * coarsening,
            .origin_mm = grid.origin_mm + 0.5 * (coarsening - 1) * grid.spacing_mm};
}

std::vector<BrickIndex> coarse_bricks(const BoneContent& content, int coarsening) {
    const glm::ivec3 size = size_in_bricks(coarse_grid(content.grid, coarsening));
    std::vector<BrickIndex> bricks;
    bricks.reserve(content.brick_of_slot.size());
    for (const BrickIndex brick : content.brick_of_slot)
        bricks.push_back(brick_index(size, coarse_brick_of(content, brick, coarsening)));
    std::sort(bricks.begin(), bricks.end());
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
    return bricks;
}

CoarseBone::CoarseBone(const Bone& fine, int coarsening) : CoarseBone(coarsening) {
    finish(fill(fine));
}

Steps CoarseBone::fill(const Bone& fine) {
    const BoneContent& content = fine.content();
    auto coarse = std::make_shared<BoneContent>();
    coarse->grid = coarse_grid(content.grid, coarsening_);
    coarse->size_bricks = size_in_bricks(coarse->grid);
    coarse->brick_of_slot = coarse_bricks(content, coarsening_);
    coarse->slot_of_brick = BrickTable(coarse->brick_of_slot);
    coarse->homogeneous_stiffness = content.homogeneous_stiffness;
    coarse->stiffness_per_code = content.stiffness_per_code;
    co_yield 0.0;
    const std::size_t slots = coarse->brick_of_slot.size();
    const std::size_t stiffness_slots = content.stiffness.empty() ? 0 : slots;
    const std::size_t tissue_slots = content.tissue.empty() ? 0 : slots;
    for (Steps part = grow(coarse->stiffness, stiffness_slots, {}); part.step();) co_yield 0.0;
    for (Steps part = grow(coarse->tissue, tissue_slots, {}); part.step();) co_yield 0.0;
    std::vector<ByteBrick> fractions;
    for (Steps part = grow(fractions, slots, {}); part.step();) co_yield 0.0;
    for (std::size_t fine_slot = 0; fine_slot < fine.stored_bricks(); ++fine_slot) {
        const BrickIndex index = content.brick_of_slot[fine_slot];
        const glm::ivec3 brick = brick_position(content.size_bricks, index);
        const auto slot = static_cast<std::size_t>(coarse->slot_of_brick.find(
            brick_index(coarse->size_bricks, coarse_brick_of(content, index, coarsening_))));
        const auto from = static_cast<std::int32_t>(fine_slot);
        average_fractions(fine, brick, from, coarsening_, fractions[slot]);
        if (!content.stiffness.empty())
            pick_codes(fine, brick, from, coarsening_, content.stiffness[fine_slot], coarse->stiffness[slot]);
        if (!content.tissue.empty())
            pick_codes(fine, brick, from, coarsening_, content.tissue[fine_slot], coarse->tissue[slot]);
        co_yield static_cast<double>(fine_slot) / static_cast<double>(fine.stored_bricks());
    }
    bone_.emplace(std::move(coarse), std::move(fractions));
}

std::span<const BrickChange> CoarseBone::update(const Bone& fine, std::span<const BrickChange> changes) {
    const BoneContent& content = fine.content();
    GatheredChanges changed;
    for (const auto& [index, voxels, kind] : changes) {
        const std::int32_t fine_slot = fine.slot(index);
        if (fine_slot == BoneContent::no_slot) continue;
        const glm::ivec3 brick = brick_position(content.size_bricks, index);
        const BrickIndex coarse =
            brick_index(bone_->content().size_bricks, coarse_brick_of(content, index, coarsening_));
        average_fractions(fine, brick, fine_slot, coarsening_, bone_->fractions(bone_->slot(coarse)));
        VoxelMask& coarse_voxels = changed.voxels(coarse);
        voxels.for_each([&](std::size_t offset) {
            coarse_voxels.set(
                offset_in_brick((brick * brick_edge_voxels + voxel_in_brick(offset)) / coarsening_));
        });
    }
    changed_ = changed.take();
    return changed_;
}

}  // namespace osteomill
