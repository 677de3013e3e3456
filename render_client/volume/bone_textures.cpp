#include "render_client/volume/bone_textures.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <stdexcept>

namespace osteomill {

namespace {

VoxelBox drawable_box(const Bone& bone) {
    const VoxelBox box = stored_box(bone.content());
    if (box.count() == 0) throw std::runtime_error("the bone has no voxel to draw");
    const int limit = gl::max_texture3d_edge();
    if (glm::max(box.size.x, glm::max(box.size.y, box.size.z)) > limit)
        throw std::runtime_error(fmt::format(
            "the bone spans {} x {} x {} voxels, this OpenGL driver draws at most {} along an axis",
            box.size.x, box.size.y, box.size.z, limit));
    return box;
}

/// Uploads a channel in layers one brick high, so that no dense copy of the whole bone is made.
gl::Texture3D upload_channel(const Bone& bone, BoneChannel channel, const VoxelBox& box,
                             gl::VoxelFormat format) {
    gl::Texture3D texture(format, box.size);
    const glm::ivec3 layer_size(box.size.x, box.size.y, brick_edge_voxels);
    std::vector<std::uint8_t> layer(VoxelBox{{}, layer_size}.count());
    for (int z = 0; z < box.size.z; z += brick_edge_voxels) {
        copy_channel(bone, channel, {box.first + glm::ivec3(0, 0, z), layer_size}, layer);
        texture.upload({0, 0, z}, layer_size, layer);
    }
    return texture;
}

gl::Texture3D upload_map(const std::vector<std::uint8_t>& map, const glm::ivec3& size,
                         gl::VoxelFormat format) {
    gl::Texture3D texture(format, size);
    texture.upload({0, 0, 0}, size, map);
    return texture;
}

std::optional<gl::Texture3D> upload_colour_code(const Bone& bone, const VoxelBox& box,
                                                const LookTable& table) {
    if (!table.channel) return std::nullopt;
    return upload_channel(bone, *table.channel, box, gl::VoxelFormat::byte_code);
}

std::optional<VisibleBone> without_hidden(const Bone& bone, const LookTable& table) {
    if (!hides_bone(table)) return std::nullopt;
    return VisibleBone(bone, table);
}

}  // namespace

BoneTextures::BoneTextures(const Bone& bone, std::span<const TissueColour> tissues, const BoneLook& look)
    : grid_(bone.grid()),
      box_(drawable_box(bone)),
      table_(look_table(bone.content(), tissues, look)),
      visible_(without_hidden(bone, table_)),
      empty_space_(shown(bone), box_),
      fraction_(upload_channel(shown(bone), BoneChannel::fraction, box_, gl::VoxelFormat::interpolated_byte)),
      distance_(upload_map(empty_space_.distance(), empty_space_.size_blocks(), gl::VoxelFormat::byte_code)),
      mean_fraction_(upload_map(empty_space_.mean_fraction(), empty_space_.size_blocks(),
                                gl::VoxelFormat::interpolated_byte)),
      colour_code_(upload_colour_code(bone, box_, table_)),
      colours_(table_.by_code) {
    if (look.shading == Shading::surface_voxels) surface_.emplace(shown(bone), table_, box_);
}

void BoneTextures::update(const Bone& carved, std::span<const BrickIndex> dirty) {
    if (visible_) visible_->follow(carved, dirty);
    const Bone& bone = shown(carved);
    const glm::ivec3 size_bricks = bone.content().size_bricks;
    for (const BrickIndex index : dirty) {
        const glm::ivec3 brick = brick_position(size_bricks, index);
        const std::int32_t slot = bone.slot(brick);
        if (slot == BoneContent::no_slot) continue;
        fraction_.upload(brick * brick_edge_voxels - box_.first, glm::ivec3(brick_edge_voxels),
                         bone.fractions(slot));
        const VoxelBox blocks = empty_space_.update_after_carving(bone, brick);
        const glm::ivec3& size = empty_space_.size_blocks();
        distance_.upload(blocks.first, blocks.size, copy_blocks(empty_space_.distance(), size, blocks));
        mean_fraction_.upload(blocks.first, blocks.size,
                              copy_blocks(empty_space_.mean_fraction(), size, blocks));
    }
    if (surface_) surface_->update(bone, dirty);
}

glm::dvec3 BoneTextures::to_box_voxels(const glm::dvec3& position_mm) const {
    // A voxel's centre is at a whole number of grid coordinates and at a half in texture coordinates.
    return to_voxel_coordinates(grid_, position_mm) + 0.5 - glm::dvec3(box_.first);
}

}  // namespace osteomill
