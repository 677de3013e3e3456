#include "render_client/volume/textures/texture_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>

#include "render_client/volume/textures/coarse_bone.h"
#include "render_client/volume/textures/empty_space.h"
#include "render_client/volume/textures/seen_through.h"

namespace osteomill {

namespace {

constexpr double bytes_per_mib = 1024.0 * 1024.0;
constexpr std::size_t bytes_per_block = 2;
constexpr std::size_t bytes_per_table_entry = 4;

std::size_t bytes_of_plan(std::size_t bytes_per_voxel, const VoxelBox& box, std::size_t stored_bricks,
                          BoneLayout layout, int longest_edge_texels) {
    const std::size_t maps = bytes_per_block * VoxelBox{{}, box.size / block_edge_voxels + 2}.count();
    if (layout == BoneLayout::dense) return bytes_per_voxel * box.count() + maps;
    const glm::ivec3 tiles = atlas_size_tiles(stored_bricks, longest_edge_texels);
    const std::size_t table = bytes_per_table_entry * VoxelBox{{}, box.size / brick_edge_voxels}.count();
    return bytes_per_voxel * VoxelBox{{}, tiles * tile_edge_texels}.count() + table + maps;
}

bool fits_edges(const VoxelBox& box, std::size_t stored_bricks, BoneLayout layout, int longest_edge_texels) {
    // The atlas' maps still span the box, one texel for each of its blocks.
    const glm::ivec3 size = layout == BoneLayout::dense ? box.size : box.size / block_edge_voxels + 2;
    if (glm::max(size.x, glm::max(size.y, size.z)) > longest_edge_texels) return false;
    return layout == BoneLayout::dense || atlas_size_tiles(stored_bricks, longest_edge_texels).x > 0;
}

}  // namespace

std::vector<TexturePlan> texture_plans(const BoneContent& content, const VoxelBytes& bytes_per_voxel,
                                       const TextureLimits& limits) {
    const int longest_edge_texels = limits.longest_edge_texels.value();
    std::vector<TexturePlan> plans;
    for (int coarsening = 1; coarsening <= coarsest; coarsening *= 2) {
        const std::vector<BrickIndex> bricks = coarse_bricks(content, coarsening);
        const VoxelBox box = box_of_bricks(size_in_bricks(coarse_grid(content.grid, coarsening)), bricks);
        for (const bool smoothed : {true, false}) {
            if (smoothed && bytes_per_voxel.smoothed == 0) continue;
            const std::size_t per_voxel = bytes_per_voxel.needed + (smoothed ? bytes_per_voxel.smoothed : 0);
            const std::size_t most_bytes = smoothed ? limits.budget_bytes / 2 : limits.budget_bytes;
            for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
                if (limits.layout && limits.layout != layout) continue;
                if (!fits_edges(box, bricks.size(), layout, longest_edge_texels)) continue;
                const std::size_t bytes =
                    bytes_of_plan(per_voxel, box, bricks.size(), layout, longest_edge_texels) +
                    (bytes_per_voxel.seen_through ? SeenLattice(box).bytes() : 0);
                if (bytes <= most_bytes) plans.push_back({layout, coarsening, bytes, smoothed});
            }
        }
    }
    return plans;
}

std::string description(const TexturePlan& plan) {
    const double mib = static_cast<double>(plan.bytes) / bytes_per_mib;
    std::string text = fmt::format(
        "{}, {:.0f} MiB", plan.layout == BoneLayout::dense ? "a dense texture" : "a brick atlas", mib);
    if (plan.coarsening > 1) text += fmt::format(", of a copy {} times coarser", plan.coarsening);
    return text;
}

}  // namespace osteomill
