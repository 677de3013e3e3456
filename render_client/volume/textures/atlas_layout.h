// Layout of a bone's bricks in its 3D textures.
//
// Dense: one box, a texel for each of its voxels. Atlas: a tile for each stored brick, its 16^3 voxels and a
// border of one that repeats those of its neighbours, so that interpolation within a brick needs no other
// tile. The first tile is empty; every brick of the box that holds no bone shares it. A brick keeps its tile
// for good, even once it is carved away: undo or backward play may fill it again, and no tile ever has to be
// found, moved or grown while bone is milled.
#pragma once

#include <span>
#include <vector>

#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

enum class BoneLayout { dense, atlas };

inline constexpr int tile_border_voxels = 1;
inline constexpr int tile_edge_texels = brick_edge_voxels + 2 * tile_border_voxels;

/// Voxels of the grid, and the texel that holds the first of them; the others follow at the same strides.
struct PlacedVoxels {
    VoxelBox voxels;
    glm::ivec3 first_texel{0};
};

class AtlasLayout {
  public:
    /// The bone has at least one brick. In an atlas no edge of the texture exceeds `longest_edge_texels`.
    /// Throws std::runtime_error, naming sizes, if not all tiles fit into such a texture.
    AtlasLayout(const BoneContent& content, BoneLayout layout, int longest_edge_texels);

    BoneLayout layout() const { return layout_; }
    /// Whole bricks that enclose every stored one, voxels of the grid.
    const VoxelBox& box() const { return box_; }
    const glm::ivec3& texture_size() const { return texture_size_; }

    /// Everything that a stored brick's texels show: its voxels, in an atlas with their border.
    PlacedVoxels of_brick(const glm::ivec3& brick, std::int32_t slot) const;

    /// All regions of the first upload. A dense one is one brick high and has at most half a million voxels,
    /// or is one row of bricks; in an atlas each is a tile, the empty tile included.
    std::vector<PlacedVoxels> all(const BoneContent& content) const;

    /// Texels that show these voxels and those up to `reach_voxels` around them: their own and, in an atlas,
    /// the borders that repeat them. In a dense layout, boxes that follow each other become one if that adds
    /// little to the upload: neighbouring bricks do, in ascending order, distant ones never. In an atlas
    /// there is one region for each tile. Bricks that are not stored show nothing. Valid until the next call.
    std::span<const PlacedVoxels> that_show(const Bone& bone, std::span<const VoxelBox> changed,
                                            int reach_voxels = 0);

    /// By brick of the box, x fastest, four bytes each: the place of its tile, counted in tiles along x, y
    /// and z, and 0.
    std::vector<std::uint8_t> tile_table(const BoneContent& content) const;

  private:
    glm::ivec3 tile_of_slot(std::int32_t slot) const;
    void add_dense_change(VoxelBox voxels);
    void add_atlas_changes(const Bone& bone, const VoxelBox& changed);

    BoneLayout layout_;
    VoxelBox box_;
    glm::ivec3 size_tiles_{0};
    glm::ivec3 texture_size_{0};
    std::vector<PlacedVoxels> shown_;

    // State of the call under way: the index of a slot's tile in shown_, and the slots that have one.
    static constexpr std::int32_t nowhere = -1;
    std::vector<std::int32_t> place_of_slot_;
    std::vector<std::int32_t> slots_shown_;
};

/// Tiles along each axis for so many bricks and the empty tile, as near a cube as can be; zero if they do not
/// fit.
glm::ivec3 atlas_size_tiles(std::size_t stored_bricks, int longest_edge_texels);

}  // namespace osteomill
