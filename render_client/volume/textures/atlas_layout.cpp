#include "render_client/volume/textures/atlas_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <stdexcept>

namespace osteomill {

namespace {

/// Rows by which an atlas' edge may exceed a cube's.
constexpr int spare_rows = 4;

VoxelBox grown(const VoxelBox& box, int reach_voxels) {
    return {box.first - reach_voxels, box.size + 2 * reach_voxels};
}

VoxelBox voxels_round_brick(const glm::ivec3& brick, int reach_voxels) {
    return grown({brick * brick_edge_voxels, glm::ivec3(brick_edge_voxels)}, reach_voxels);
}

VoxelBox overlap(const VoxelBox& a, const VoxelBox& b) {
    const glm::ivec3 low = glm::max(a.first, b.first);
    const glm::ivec3 high = glm::min(a.first + a.size, b.first + b.size);
    return {low, glm::max(high - low, 0)};
}

VoxelBox enclosing(const VoxelBox& a, const VoxelBox& b) {
    const glm::ivec3 low = glm::min(a.first, b.first);
    const glm::ivec3 high = glm::max(a.first + a.size, b.first + b.size);
    return {low, high - low};
}

/// Rows of a region of a dense texture, in whole bricks: a region takes a few milliseconds, even with
/// smoothing.
int rows_a_region(int row_voxels) {
    constexpr int voxels_a_region = 1 << 19;
    return std::max(voxels_a_region / (row_voxels * brick_edge_voxels * brick_edge_voxels), 1) *
           brick_edge_voxels;
}

}  // namespace

glm::ivec3 atlas_size_tiles(std::size_t stored_bricks, int longest_edge_texels) {
    // The table of tiles counts them in bytes.
    const int longest = std::min(longest_edge_texels / tile_edge_texels, 256);
    const auto tiles = static_cast<std::int64_t>(stored_bricks) + 1;
    const auto layers_on = [&](const glm::ivec2& layer) {
        const std::int64_t in_layer = std::int64_t{1} * layer.x * layer.y;
        return (tiles + in_layer - 1) / in_layer;
    };
    const int edge = std::clamp(static_cast<int>(std::ceil(std::cbrt(static_cast<double>(tiles)))), 1,
                                std::max(longest, 1));
    // The nearly cubic shape with the fewest tiles to spare.
    glm::ivec3 best(0);
    std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
    for (int y = edge; y <= std::min(edge + spare_rows, longest); ++y)
        for (int x = y; x <= std::min(edge + spare_rows, longest); ++x) {
            const std::int64_t layers = layers_on({x, y});
            if (layers > longest || layers * x * y >= fewest) continue;
            fewest = layers * x * y;
            best = {x, y, static_cast<int>(layers)};
        }
    return best;
}

AtlasLayout::AtlasLayout(const BoneContent& content, BoneLayout layout, int longest_edge_texels)
    : layout_(layout), box_(stored_box(content)) {
    if (layout == BoneLayout::dense) {
        texture_size_ = box_.size;
        return;
    }
    size_tiles_ = atlas_size_tiles(content.brick_of_slot.size(), longest_edge_texels);
    if (size_tiles_.x == 0)
        throw std::runtime_error(fmt::format("{} bricks do not fit into a 3D texture of {} texels an edge",
                                             content.brick_of_slot.size(), longest_edge_texels));
    texture_size_ = size_tiles_ * tile_edge_texels;
    place_of_slot_.resize(content.brick_of_slot.size(), nowhere);
}

glm::ivec3 AtlasLayout::tile_of_slot(std::int32_t slot) const {
    return brick_position(size_tiles_, static_cast<BrickIndex>(slot) + 1);
}

PlacedVoxels AtlasLayout::of_brick(const glm::ivec3& brick, std::int32_t slot) const {
    if (layout_ == BoneLayout::dense)
        return {voxels_round_brick(brick, 0), brick * brick_edge_voxels - box_.first};
    return {voxels_round_brick(brick, tile_border_voxels), tile_of_slot(slot) * tile_edge_texels};
}

std::vector<PlacedVoxels> AtlasLayout::all(const BoneContent& content) const {
    std::vector<PlacedVoxels> all;
    if (layout_ == BoneLayout::dense) {
        // Parts of layers: no dense copy of the whole bone is ever made, and none takes long.
        const int rows = rows_a_region(box_.size.x);
        for (int z = 0; z < box_.size.z; z += brick_edge_voxels)
            for (int y = 0; y < box_.size.y; y += rows) {
                const glm::ivec3 first(0, y, z);
                const glm::ivec3 size(box_.size.x, std::min(rows, box_.size.y - y), brick_edge_voxels);
                all.push_back({{box_.first + first, size}, first});
            }
        return all;
    }
    // No voxel lies before the grid, so the empty tile comes out empty. So do the spare tiles, which a driver
    // would leave undefined.
    const auto add_empty = [&](std::size_t tile) {
        all.push_back({{glm::ivec3(-tile_edge_texels), glm::ivec3(tile_edge_texels)},
                       brick_position(size_tiles_, static_cast<BrickIndex>(tile)) * tile_edge_texels});
    };
    add_empty(0);
    const std::size_t stored = content.brick_of_slot.size();
    for (std::size_t slot = 0; slot < stored; ++slot)
        all.push_back(of_brick(brick_position(content.size_bricks, content.brick_of_slot[slot]),
                               static_cast<std::int32_t>(slot)));
    for (std::size_t tile = stored + 1; tile < VoxelBox{{}, size_tiles_}.count(); ++tile) add_empty(tile);
    return all;
}

std::span<const PlacedVoxels> AtlasLayout::that_show(const Bone& bone, std::span<const VoxelBox> changed,
                                                     int reach_voxels) {
    shown_.clear();
    // Smoothed values reach into the borders of tiles, beyond the box.
    const VoxelBox held = grown(box_, layout_ == BoneLayout::atlas ? tile_border_voxels : 0);
    for (const VoxelBox& box : changed) {
        const VoxelBox voxels = overlap(grown(box, reach_voxels), held);
        if (voxels.count() == 0) continue;
        if (layout_ == BoneLayout::atlas)
            add_atlas_changes(bone, voxels);
        else
            add_dense_change(voxels);
    }
    for (const std::int32_t slot : slots_shown_) place_of_slot_[static_cast<std::size_t>(slot)] = nowhere;
    slots_shown_.clear();
    return shown_;
}

void AtlasLayout::add_dense_change(VoxelBox voxels) {
    // A quarter more texels are worth one region less, and voxels that neighbours share are not shown twice.
    while (!shown_.empty()) {
        const VoxelBox& last = shown_.back().voxels;
        const VoxelBox both = enclosing(voxels, last);
        if (4 * both.count() > 5 * (voxels.count() + last.count())) break;
        voxels = both;
        shown_.pop_back();
    }
    shown_.push_back({voxels, voxels.first - box_.first});
}

void AtlasLayout::add_atlas_changes(const Bone& bone, const VoxelBox& changed) {
    const glm::ivec3 end = changed.first + changed.size;
    const glm::ivec3 low = glm::max(changed.first - tile_border_voxels, 0) / brick_edge_voxels;
    const glm::ivec3 high =
        glm::min((end - 1 + tile_border_voxels) / brick_edge_voxels, bone.content().size_bricks - 1);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                const glm::ivec3 other(x, y, z);
                const std::int32_t slot = bone.slot(other);
                if (slot == BoneContent::no_slot) continue;
                const PlacedVoxels tile = of_brick(other, slot);
                VoxelBox voxels = overlap(changed, tile.voxels);
                std::int32_t& place = place_of_slot_[static_cast<std::size_t>(slot)];
                if (place == nowhere) {
                    place = static_cast<std::int32_t>(shown_.size());
                    slots_shown_.push_back(slot);
                    shown_.emplace_back();
                } else {
                    voxels = enclosing(voxels, shown_[static_cast<std::size_t>(place)].voxels);
                }
                shown_[static_cast<std::size_t>(place)] = {
                    voxels, tile.first_texel + voxels.first - tile.voxels.first};
            }
}

std::vector<std::uint8_t> AtlasLayout::tile_table(const BoneContent& content) const {
    const glm::ivec3 size = box_.size / brick_edge_voxels;
    std::vector<std::uint8_t> table(4 * VoxelBox{{}, size}.count(), 0);
    for (std::size_t slot = 0; slot < content.brick_of_slot.size(); ++slot) {
        const glm::ivec3 brick = brick_position(content.size_bricks, content.brick_of_slot[slot]);
        const glm::ivec3 tile = tile_of_slot(static_cast<std::int32_t>(slot));
        const std::size_t entry = std::size_t{4} * brick_index(size, brick - box_.first / brick_edge_voxels);
        for (int axis = 0; axis < 3; ++axis)
            table[entry + static_cast<std::size_t>(axis)] = static_cast<std::uint8_t>(tile[axis]);
    }
    return table;
}

}  // namespace osteomill
