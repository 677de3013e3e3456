#include "render_client/volume/empty_space.h"

#include <algorithm>
#include <glm/common.hpp>

namespace osteomill {

namespace {

constexpr std::uint8_t half_full = 128;
constexpr std::uint8_t farthest = 255;

/// Fractions of the voxels of some blocks and of a border of one voxel around them.
class BorderedVoxels {
  public:
    BorderedVoxels(const Bone& bone, const glm::ivec3& first_voxel, const glm::ivec3& size_blocks)
        : size_(size_blocks * block_edge_voxels + 2), voxels_(VoxelBox{{}, size_}.count()) {
        copy_channel(bone, BoneChannel::fraction, {first_voxel - 1, size_}, voxels_);
    }

    /// Whether any voxel that interpolation reads within the block is at least half full.
    bool can_hold_surface(const glm::ivec3& block) const {
        const glm::ivec3 first = block * block_edge_voxels;
        for (int z = 0; z < block_edge_voxels + 2; ++z)
            for (int y = 0; y < block_edge_voxels + 2; ++y) {
                const std::uint8_t* row = at(first + glm::ivec3(0, y, z));
                if (std::any_of(row, row + block_edge_voxels + 2,
                                [](std::uint8_t fraction) { return fraction >= half_full; }))
                    return true;
            }
        return false;
    }

    std::uint8_t mean(const glm::ivec3& block) const {
        const glm::ivec3 first = block * block_edge_voxels + 1;
        int sum = 0;
        for (int z = 0; z < block_edge_voxels; ++z)
            for (int y = 0; y < block_edge_voxels; ++y) {
                const std::uint8_t* row = at(first + glm::ivec3(0, y, z));
                sum += row[0] + row[1] + row[2] + row[3];
            }
        return static_cast<std::uint8_t>(sum / 64);
    }

  private:
    const std::uint8_t* at(const glm::ivec3& voxel) const {
        return voxels_.data() + (static_cast<std::size_t>(voxel.z) * size_.y + voxel.y) * size_.x + voxel.x;
    }

    glm::ivec3 size_;
    std::vector<std::uint8_t> voxels_;
};

}  // namespace

EmptySpace::EmptySpace(const Bone& bone, const VoxelBox& box)
    : box_(box),
      size_blocks_(box.size / block_edge_voxels + 2),
      distance_(VoxelBox{{}, size_blocks_}.count(), 0),
      mean_fraction_(distance_.size(), 0) {
    // Layer by layer, so that no dense copy of a large bone is needed.
    for (int layer = 0; layer < size_blocks_.z; ++layer)
        classify(bone, {{0, 0, layer}, {size_blocks_.x, size_blocks_.y, 1}});
    spread_distances();
}

VoxelBox EmptySpace::update_after_carving(const Bone& bone, const glm::ivec3& brick) {
    constexpr int blocks_per_brick = brick_edge_voxels / block_edge_voxels;
    const glm::ivec3 own = (brick * brick_edge_voxels - box_.first) / block_edge_voxels + 1;
    // Interpolation carries a change one voxel into the blocks around the brick.
    const glm::ivec3 low = glm::max(own - 1, 0);
    const glm::ivec3 high = glm::min(own + blocks_per_brick + 1, size_blocks_);
    const VoxelBox blocks{low, glm::max(high - low, 0)};
    if (blocks.count() > 0) classify(bone, blocks);
    return blocks;
}

void EmptySpace::classify(const Bone& bone, const VoxelBox& blocks) {
    const BorderedVoxels voxels(bone, box_.first + (blocks.first - 1) * block_edge_voxels, blocks.size);
    for (int z = 0; z < blocks.size.z; ++z)
        for (int y = 0; y < blocks.size.y; ++y)
            for (int x = 0; x < blocks.size.x; ++x) {
                const glm::ivec3 block(x, y, z);
                const std::size_t place = index(blocks.first + block);
                mean_fraction_[place] = voxels.mean(block);
                const std::uint8_t if_empty = std::max<std::uint8_t>(distance_[place], 1);
                distance_[place] = voxels.can_hold_surface(block) ? std::uint8_t{0} : if_empty;
            }
}

void EmptySpace::spread_distances() {
    for (std::uint8_t& distance : distance_) distance = distance == 0 ? 0 : farthest;
    // Two sweeps over half of the 26 neighbours each give the exact chessboard distance (Borgefors 1984).
    const auto relax = [&](const glm::ivec3& block, int side) {
        int nearest = distance_[index(block)];
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    if (side * (dx + 3 * (dy + 3 * dz)) >= 0) continue;
                    const glm::ivec3 other = block + glm::ivec3(dx, dy, dz);
                    if (contains(Grid{.size_voxels = size_blocks_}, other))
                        nearest = std::min(nearest, distance_[index(other)] + 1);
                }
        distance_[index(block)] = static_cast<std::uint8_t>(nearest);
    };
    for (int z = 0; z < size_blocks_.z; ++z)
        for (int y = 0; y < size_blocks_.y; ++y)
            for (int x = 0; x < size_blocks_.x; ++x) relax({x, y, z}, 1);
    for (int z = size_blocks_.z - 1; z >= 0; --z)
        for (int y = size_blocks_.y - 1; y >= 0; --y)
            for (int x = size_blocks_.x - 1; x >= 0; --x) relax({x, y, z}, -1);
}

std::vector<std::uint8_t> copy_blocks(const std::vector<std::uint8_t>& map, const glm::ivec3& size_blocks,
                                      const VoxelBox& blocks) {
    std::vector<std::uint8_t> copy;
    copy.reserve(blocks.count());
    for (int z = blocks.first.z; z < blocks.first.z + blocks.size.z; ++z)
        for (int y = blocks.first.y; y < blocks.first.y + blocks.size.y; ++y) {
            const auto row = map.begin() +
                             (static_cast<std::ptrdiff_t>(z) * size_blocks.y + y) * size_blocks.x +
                             blocks.first.x;
            copy.insert(copy.end(), row, row + blocks.size.x);
        }
    return copy;
}

}  // namespace osteomill
