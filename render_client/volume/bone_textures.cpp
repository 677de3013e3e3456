#include "render_client/volume/bone_textures.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <stdexcept>
#include <utility>

namespace osteomill {

namespace {

const Bone& drawable(const Bone& bone) {
    if (bone.stored_bricks() == 0) throw std::runtime_error("the bone has no voxel to draw");
    return bone;
}

const Bone& drawn_bone(const Bone& bone, const std::optional<CoarseBone>& copy) {
    return copy ? copy->bone() : bone;
}

void upload_voxels(gl::Texture3D& texture, const Bone& bone, BoneChannel channel, const PlacedVoxels& placed,
                   std::vector<std::uint8_t>& scratch) {
    scratch.resize(placed.voxels.count());
    copy_channel(bone, channel, placed.voxels, scratch);
    texture.upload(placed.first_texel, placed.voxels.size, scratch);
}

gl::Texture3D upload_channel(const Bone& bone, BoneChannel channel, const BrickPlaces& places,
                             gl::VoxelFormat format) {
    gl::Texture3D texture(format, places.texture_size());
    std::vector<std::uint8_t> scratch;
    if (places.layout() == BoneLayout::dense) {
        // Layers one brick high, so that no dense copy of the whole bone is made.
        const VoxelBox& box = places.box();
        for (int z = 0; z < box.size.z; z += brick_edge_voxels) {
            const glm::ivec3 first(0, 0, z);
            const VoxelBox layer{box.first + first, {box.size.x, box.size.y, brick_edge_voxels}};
            upload_voxels(texture, bone, channel, {layer, first}, scratch);
        }
        return texture;
    }
    scratch.assign(VoxelBox{{}, glm::ivec3(tile_edge_texels)}.count(), 0);
    texture.upload({0, 0, 0}, glm::ivec3(tile_edge_texels), scratch);
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 brick = brick_position(content.size_bricks, content.brick_of_slot[slot]);
        upload_voxels(texture, bone, channel, places.of_brick(brick, static_cast<std::int32_t>(slot)),
                      scratch);
    }
    return texture;
}

std::optional<gl::Texture3D> upload_colour_code(const Bone& bone, const BrickPlaces& places) {
    if (!bone.content().tissue.empty())
        return upload_channel(bone, BoneChannel::tissue, places, gl::VoxelFormat::byte_code);
    if (!bone.content().stiffness.empty())
        return upload_channel(bone, BoneChannel::stiffness, places, gl::VoxelFormat::byte_code);
    return std::nullopt;
}

std::optional<gl::Texture3D> upload_tile_table(const BoneContent& content, const BrickPlaces& places) {
    if (places.layout() == BoneLayout::dense) return std::nullopt;
    const glm::ivec3 size = places.box().size / brick_edge_voxels;
    gl::Texture3D texture(gl::VoxelFormat::byte_codes, size);
    texture.upload({0, 0, 0}, size, places.tile_table(content));
    return texture;
}

ColourTable colours_of(const BoneContent& content, std::span<const TissueColour> tissues) {
    if (!content.tissue.empty()) return colours_by_tissue(tissues);
    if (!content.stiffness.empty()) return colours_by_stiffness(content.stiffness_per_code);
    ColourTable plain;
    plain.fill(plain_bone_colour());
    return plain;
}

}  // namespace

BoneTextures::BoneTextures(const Bone& bone, std::span<const TissueColour> tissues,
                           const TextureLimits& limits)
    : BoneTextures(first_that_fits(drawable(bone), tissues, limits)) {}

BoneTextures BoneTextures::first_that_fits(const Bone& bone, std::span<const TissueColour> tissues,
                                           const TextureLimits& limits) {
    TextureLimits driven = limits;
    driven.longest_edge_texels = limits.longest_edge_texels.value_or(gl::max_texture3d_edge());
    std::string refusal = fmt::format("the limit is {} MiB of textures of at most {} texels an edge",
                                      limits.budget_bytes >> 20U, *driven.longest_edge_texels);
    for (const TexturePlan& plan : texture_plans(bone.content(), driven)) {
        try {
            std::optional<CoarseBone> copy;
            if (plan.coarsening > 1) copy.emplace(bone, plan.coarsening);
            return {bone, std::move(copy), tissues, plan, *driven.longest_edge_texels};
        } catch (const gl::NoTextureMemory& error) {
            refusal = error.what();
        }
    }
    throw std::runtime_error(fmt::format(
        "the bone's {} bricks of 16^3 voxels exceed the graphics memory, even {} times coarser: {}",
        bone.stored_bricks(), coarsest, refusal));
}

BoneTextures::BoneTextures(const Bone& bone, std::optional<CoarseBone> copy,
                           std::span<const TissueColour> tissues, const TexturePlan& plan,
                           int longest_edge_texels)
    : plan_(plan),
      size_bricks_(bone.content().size_bricks),
      copy_(std::move(copy)),
      grid_(drawn_bone(bone, copy_).grid()),
      places_(drawn_bone(bone, copy_).content(), plan.layout, longest_edge_texels),
      empty_space_(drawn_bone(bone, copy_), places_.box()),
      fraction_(upload_channel(drawn_bone(bone, copy_), BoneChannel::fraction, places_,
                               gl::VoxelFormat::interpolated_byte)),
      blocks_(gl::VoxelFormat::interpolated_bytes, empty_space_.size_blocks()),
      tile_table_(upload_tile_table(drawn_bone(bone, copy_).content(), places_)),
      colour_code_(upload_colour_code(drawn_bone(bone, copy_), places_)),
      colours_(colours_of(bone.content(), tissues)) {
    const glm::ivec3& size = empty_space_.size_blocks();
    for (int z = 0; z < size.z; ++z) upload_blocks({{0, 0, z}, {size.x, size.y, 1}});
}

void BoneTextures::update(const Bone& bone, std::span<const BrickIndex> dirty) {
    if (copy_) dirty = copy_->update(bone, dirty);
    const Bone& drawn = drawn_bone(bone, copy_);
    for (const PlacedVoxels& placed : places_.that_show(drawn, dirty))
        upload_voxels(fraction_, drawn, BoneChannel::fraction, placed, scratch_);
    for (const VoxelBox& blocks : empty_space_.update(drawn, dirty)) upload_blocks(blocks);
}

void BoneTextures::upload_blocks(const VoxelBox& blocks) {
    const glm::ivec3& size = empty_space_.size_blocks();
    scratch_.resize(2 * blocks.count());
    std::uint8_t* texel = scratch_.data();
    for (int z = blocks.first.z; z < blocks.first.z + blocks.size.z; ++z)
        for (int y = blocks.first.y; y < blocks.first.y + blocks.size.y; ++y) {
            std::size_t block = (static_cast<std::size_t>(z) * size.y + y) * size.x + blocks.first.x;
            for (int x = 0; x < blocks.size.x; ++x, ++block) {
                *texel++ = empty_space_.mean_fraction()[block];
                *texel++ = empty_space_.distance()[block];
            }
        }
    blocks_.upload(blocks.first, blocks.size, scratch_);
}

VoxelBox BoneTextures::voxels_of_brick(BrickIndex brick) const {
    const int edge = brick_edge_voxels / plan_.coarsening;
    return {brick_position(size_bricks_, brick) * edge, glm::ivec3(edge)};
}

glm::dvec3 BoneTextures::to_box_voxels(const glm::dvec3& position_mm) const {
    // A voxel's centre is at a whole number of grid coordinates and at a half in texture coordinates.
    return to_voxel_coordinates(grid_, position_mm) + 0.5 - glm::dvec3(box().first);
}

}  // namespace osteomill
