#include "render_client/volume/textures/empty_space.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/common.hpp>

namespace osteomill {

namespace {

constexpr int neighbour_count = 27;
constexpr BlockReach all_around = (1U << neighbour_count) - 1;

/// For each neighbour, the voxels of a block that touch it, as bits, x fastest.
constexpr std::array<std::uint64_t, neighbour_count> voxels_towards() {
    const auto touches = [](int place, int side) {
        return side == 0 || place == (side < 0 ? 0 : block_edge_voxels - 1);
    };
    std::array<std::uint64_t, neighbour_count> towards{};
    for (int bit = 0; bit < neighbour_count; ++bit)
        for (int voxel = 0; voxel < 64; ++voxel) {
            const int dx = bit % 3 - 1, dy = bit / 3 % 3 - 1, dz = bit / 9 - 1;
            if (touches(voxel & 3, dx) && touches(voxel >> 2 & 3, dy) && touches(voxel >> 4, dz))
                towards[static_cast<std::size_t>(bit)] |= std::uint64_t{1} << voxel;
        }
    return towards;
}

BlockReach reach_of(std::uint64_t half_full) {
    static constexpr std::array<std::uint64_t, neighbour_count> towards = voxels_towards();
    if (half_full == 0) return 0;
    if (half_full == ~std::uint64_t{0}) return all_around;
    BlockReach reach = 0;
    for (std::size_t bit = 0; bit < towards.size(); ++bit)
        reach |= static_cast<BlockReach>((half_full & towards[bit]) != 0) << bit;
    return reach;
}

std::uint32_t four_bytes(const std::uint8_t* bytes) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return word;
}

/// Top bits of four bytes, as the low four bits in the same order (on a little-endian machine, byte 0 first).
std::uint64_t top_bits(std::uint32_t four) {
    return ((four >> 7 & 0x01010101U) * 0x01020408U >> 24 & 0xFU);
}

}  // namespace

BrickSummary summary_of_brick(BrickFractions fractions) {
    BrickSummary summary;
    std::size_t block = 0;
    for (int z = 0; z < brick_edge_voxels; z += block_edge_voxels)
        for (int y = 0; y < brick_edge_voxels; y += block_edge_voxels)
            for (int x = 0; x < brick_edge_voxels; x += block_edge_voxels, ++block) {
                std::uint64_t half_full = 0;
                std::uint32_t two_sums = 0;  // of even and of odd bytes: at most 16 rows * 2 * 255 each
                for (int row = 0; row < 16; ++row) {
                    const std::uint32_t four =
                        four_bytes(fractions.data() + offset_in_brick({x, y + (row & 3), z + (row >> 2)}));
                    half_full |= top_bits(four) << (4 * row);
                    two_sums += (four & 0x00FF00FFU) + (four >> 8 & 0x00FF00FFU);
                }
                summary.reach[block] = reach_of(half_full);
                summary.mean_fraction[block] =
                    static_cast<std::uint8_t>(((two_sums & 0xFFFFU) + (two_sums >> 16)) / 64);
            }
    return summary;
}

namespace {

constexpr std::uint8_t farthest = 255;

/// Changes are reported in cubes of so many blocks: a burr of 5 mm touches a few dozen of them.
constexpr int tile_edge_blocks = 8;

/// Lowers a row of distances to one more than the least of the neighbouring rows, at x - 1, x and x + 1.
class RowRelaxation {
  public:
    explicit RowRelaxation(int length) : least_(static_cast<std::size_t>(length)) {}

    void begin() { std::fill(least_.begin(), least_.end(), farthest); }
    void neighbour(const std::uint8_t* row) {
        for (std::size_t x = 0; x < least_.size(); ++x) least_[x] = std::min(least_[x], row[x]);
    }
    void apply(std::uint8_t* row) const {
        const std::size_t last = least_.size() - 1;
        for (std::size_t x = 1; x < last; ++x)
            lower(row[x], std::min(std::min(least_[x - 1], least_[x + 1]), least_[x]));
        lower(row[0], std::min(least_[0], least_[1]));
        lower(row[last], std::min(least_[last - 1], least_[last]));
    }
    static void lower(std::uint8_t& distance, std::uint8_t neighbour) {
        const auto further = static_cast<std::uint8_t>(std::min<std::uint8_t>(neighbour, farthest - 1) + 1);
        distance = std::min(distance, further);
    }

  private:
    std::vector<std::uint8_t> least_;
};

}  // namespace

EmptySpace::EmptySpace(const VoxelBox& box)
    : box_(box),
      size_blocks_(box.size / block_edge_voxels + 2),
      size_tiles_((size_blocks_ + (tile_edge_blocks - 1)) / tile_edge_blocks) {}

EmptySpace::EmptySpace(const Bone& bone, const VoxelBox& box) : EmptySpace(box) {
    finish(fill(bone));
}

Steps EmptySpace::fill(const Bone& bone) {
    const std::size_t blocks = VoxelBox{{}, size_blocks_}.count();
    for (Steps part = grow(distance_, blocks, farthest); part.step();) co_yield part_of(part, 0.0, 0.1);
    for (Steps part = grow(mean_fraction_, blocks, std::uint8_t{0}); part.step();)
        co_yield part_of(part, 0.1, 0.2);
    for (Steps part = grow(reached_by_, blocks, std::uint8_t{0}); part.step();)
        co_yield part_of(part, 0.2, 0.25);
    for (Steps part = grow(reach_of_slot_, bone.stored_bricks(), {}); part.step();)
        co_yield part_of(part, 0.25, 0.3);
    tile_is_changed_.resize(VoxelBox{{}, size_tiles_}.count(), 0);
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const BrickIndex brick = bone.content().brick_of_slot[slot];
        take_in(bone, brick_position(bone.content().size_bricks, brick), static_cast<std::int32_t>(slot));
        for (const glm::ivec3& block : newly_reached_) distance_[index(block)] = 0;
        newly_reached_.clear();
        co_yield 0.3 + 0.3 * static_cast<double>(slot) / static_cast<double>(bone.stored_bricks());
    }
    for (const VoxelBox& tile : changed_tiles_)
        tile_is_changed_[brick_index(size_tiles_, tile.first / tile_edge_blocks)] = 0;
    changed_tiles_.clear();
    for (Steps part = spread_everywhere(); part.step();) co_yield part_of(part, 0.6, 1.0);
}

std::span<const VoxelBox> EmptySpace::update(const Bone& bone, std::span<const BrickChange> changes) {
    newly_reached_.clear();
    newly_free_.clear();
    changed_tiles_.clear();
    for (const BrickChange& change : changes) {
        const std::int32_t slot = bone.slot(change.brick);
        if (slot == BoneContent::no_slot) continue;
        take_in(bone, brick_position(bone.content().size_bricks, change.brick), slot);
    }
    // Bone may have left a block in one brick and reached it from another; only the outcome counts.
    for (const glm::ivec3& block : newly_free_) {
        if (reached_by_[index(block)] > 0 || distance_[index(block)] != 0) continue;
        distance_[index(block)] = 1;
        mark_changed(block);
    }
    spread_from_reached();
    for (const VoxelBox& tile : changed_tiles_)
        tile_is_changed_[brick_index(size_tiles_, tile.first / tile_edge_blocks)] = 0;
    return changed_tiles_;
}

void EmptySpace::take_in(const Bone& bone, const glm::ivec3& brick, std::int32_t slot) {
    const BrickSummary summary = summary_of_brick(bone.fractions(slot));
    auto& known_reach = reach_of_slot_[static_cast<std::size_t>(slot)];
    for (std::size_t number = 0; number < blocks_per_brick; ++number) {
        const glm::ivec3 block = block_of(brick, number);
        std::uint8_t& mean = mean_fraction_[index(block)];
        if (mean != summary.mean_fraction[number]) {
            mean = summary.mean_fraction[number];
            mark_changed(block);
        }
        const BlockReach reach = summary.reach[number];
        for (BlockReach changed = reach ^ known_reach[number]; changed != 0; changed &= changed - 1) {
            const int bit = std::countr_zero(changed);
            const glm::ivec3 neighbour = block + neighbour_of_bit(bit);
            std::uint8_t& reached_by = reached_by_[index(neighbour)];
            if ((reach >> bit & 1U) != 0) {
                if (reached_by++ == 0) newly_reached_.push_back(neighbour);
            } else if (--reached_by == 0) {
                newly_free_.push_back(neighbour);
            }
        }
        known_reach[number] = reach;
    }
}

Steps EmptySpace::spread_everywhere() {
    // Two sweeps over half of the 26 neighbours each give the exact chessboard distance (Borgefors 1984).
    RowRelaxation relaxation(size_blocks_.x);
    const auto sweep_row = [&](int y, int z, int side) {
        const auto row_at = [&](int row_y, int row_z) { return &distance_[index({0, row_y, row_z})]; };
        relaxation.begin();
        const int before = z - side;
        if (before >= 0 && before < size_blocks_.z)
            for (int row_y = std::max(y - 1, 0); row_y <= std::min(y + 1, size_blocks_.y - 1); ++row_y)
                relaxation.neighbour(row_at(row_y, before));
        if (y - side >= 0 && y - side < size_blocks_.y) relaxation.neighbour(row_at(y - side, z));
        std::uint8_t* row = row_at(y, z);
        relaxation.apply(row);
        if (side > 0)
            for (int x = 1; x < size_blocks_.x; ++x) RowRelaxation::lower(row[x], row[x - 1]);
        else
            for (int x = size_blocks_.x - 2; x >= 0; --x) RowRelaxation::lower(row[x], row[x + 1]);
    };
    const double layers = 2.0 * size_blocks_.z;
    for (int z = 0; z < size_blocks_.z; ++z) {
        for (int y = 0; y < size_blocks_.y; ++y) sweep_row(y, z, 1);
        co_yield z / layers;
    }
    for (int z = size_blocks_.z - 1; z >= 0; --z) {
        for (int y = size_blocks_.y - 1; y >= 0; --y) sweep_row(y, z, -1);
        co_yield 1.0 - z / layers;
    }
}

void EmptySpace::spread_from_reached() {
    // Breadth first, so that a distance is lowered only once or twice.
    std::size_t next = 0;
    std::erase_if(newly_reached_, [&](const glm::ivec3& block) {
        return reached_by_[index(block)] == 0 || distance_[index(block)] == 0;
    });
    for (const glm::ivec3& block : newly_reached_) {
        distance_[index(block)] = 0;
        mark_changed(block);
    }
    for (; next < newly_reached_.size(); ++next) {
        const glm::ivec3 block = newly_reached_[next];
        const int further = std::min(distance_[index(block)] + 1, static_cast<int>(farthest));
        const glm::ivec3 low = glm::max(block - 1, 0);
        const glm::ivec3 high = glm::min(block + 1, size_blocks_ - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    std::uint8_t& distance = distance_[index({x, y, z})];
                    if (distance <= further) continue;
                    distance = static_cast<std::uint8_t>(further);
                    mark_changed({x, y, z});
                    newly_reached_.emplace_back(x, y, z);
                }
    }
}

void EmptySpace::mark_changed(const glm::ivec3& block) {
    const glm::ivec3 tile = block / tile_edge_blocks;
    std::uint8_t& is_changed = tile_is_changed_[brick_index(size_tiles_, tile)];
    if (is_changed != 0) return;
    is_changed = 1;
    const glm::ivec3 first = tile * tile_edge_blocks;
    changed_tiles_.push_back({first, glm::min(glm::ivec3(tile_edge_blocks), size_blocks_ - first)});
}

}  // namespace osteomill
