#include "render_client/volume/textures/bone_textures.h"

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

void upload_voxels(gl::Texture3D& texture, const Bone& bone, BoneChannel channel, const PlacedVoxels& placed,
                   std::vector<std::uint8_t>& scratch) {
    scratch.resize(placed.voxels.count());
    copy_channel(bone, channel, placed.voxels, scratch);
    texture.upload(placed.first_texel, placed.voxels.size, scratch);
}

gl::Texture3D upload_channel(const Bone& bone, BoneChannel channel, const AtlasLayout& places,
                             gl::VoxelFormat format) {
    gl::Texture3D texture(format, places.texture_size());
    std::vector<std::uint8_t> scratch;
    for (const PlacedVoxels& placed : places.all(bone.content()))
        upload_voxels(texture, bone, channel, placed, scratch);
    return texture;
}

std::optional<gl::Texture3D> upload_colour_code(const Bone& bone, const AtlasLayout& places,
                                                const LookTable& table) {
    if (!table.codes.exist()) return std::nullopt;
    gl::Texture3D texture(gl::VoxelFormat::byte_code, places.texture_size());
    std::vector<std::uint8_t> scratch;
    for (const PlacedVoxels& placed : places.all(bone.content())) {
        scratch.resize(placed.voxels.count());
        copy_codes(bone, table.codes, placed.voxels, scratch);
        texture.upload(placed.first_texel, placed.voxels.size, scratch);
    }
    return texture;
}

std::optional<VisibleBone> without_hidden(const Bone& bone, const LookTable& table) {
    if (!hides_bone(table)) return std::nullopt;
    return VisibleBone(bone, table);
}

VoxelBytes bytes_per_voxel(const LookTable& table, Shading shading) {
    const bool published = shading == Shading::surface_voxels;
    return {.needed = std::size_t{1} + (table.codes.exist() ? 1 : 0) + (published ? sizeof(SurfaceTexel) : 0),
            .smoothed = published ? std::size_t{0} : std::size_t{1}};
}

std::optional<gl::Texture3D> upload_tile_table(const BoneContent& content, const AtlasLayout& places) {
    if (places.layout() == BoneLayout::dense) return std::nullopt;
    const glm::ivec3 size = places.box().size / brick_edge_voxels;
    gl::Texture3D texture(gl::VoxelFormat::byte_codes, size);
    texture.upload({0, 0, 0}, size, places.tile_table(content));
    return texture;
}

}  // namespace

BoneTextures::BoneTextures(const Bone& bone, std::span<const TissueColour> tissues,
                           const ShadingSettings& look, const TextureLimits& limits)
    : BoneTextures(
          first_that_fits(drawable(bone), look_table(bone.content(), tissues, look), look.shading, limits)) {}

BoneTextures BoneTextures::first_that_fits(const Bone& bone, const LookTable& table, Shading shading,
                                           const TextureLimits& limits) {
    TextureLimits driven = limits;
    driven.longest_edge_texels = limits.longest_edge_texels.value_or(gl::max_texture3d_edge());
    std::string refusal = fmt::format("the limit is {} MiB of textures of at most {} texels an edge",
                                      limits.budget_bytes >> 20U, *driven.longest_edge_texels);
    for (const TexturePlan& plan : texture_plans(bone.content(), bytes_per_voxel(table, shading), driven)) {
        try {
            std::optional<CoarseBone> copy;
            if (plan.coarsening > 1) copy.emplace(bone, plan.coarsening);
            return {bone, std::move(copy), table, shading, plan, *driven.longest_edge_texels};
        } catch (const gl::NoTextureMemory& error) {
            refusal = error.what();
        }
    }
    throw std::runtime_error(fmt::format(
        "the bone's {} bricks of 16^3 voxels exceed the graphics memory, even {} times coarser: {}",
        bone.stored_bricks(), coarsest, refusal));
}

BoneTextures::BoneTextures(const Bone& bone, std::optional<CoarseBone> copy, const LookTable& table,
                           Shading shading, const TexturePlan& plan, int longest_edge_texels)
    : plan_(plan),
      table_(table),
      copy_(std::move(copy)),
      visible_(without_hidden(copied(bone), table_)),
      grid_(shown(bone).grid()),
      places_(shown(bone).content(), plan.layout, longest_edge_texels),
      empty_space_(shown(bone), places_.box()),
      fraction_(
          upload_channel(shown(bone), BoneChannel::fraction, places_, gl::VoxelFormat::interpolated_byte)),
      blocks_(gl::VoxelFormat::interpolated_bytes, empty_space_.size_blocks()),
      tile_table_(upload_tile_table(shown(bone).content(), places_)),
      colour_code_(upload_colour_code(shown(bone), places_, table_)),
      colours_(table_.by_code) {
    if (plan_.smoothed) smoothed_.emplace(shown(bone), table_, places_);
    if (shading == Shading::surface_voxels) surface_.emplace(shown(bone), table_, places_);
    const glm::ivec3& size = empty_space_.size_blocks();
    for (int z = 0; z < size.z; ++z) upload_blocks({{0, 0, z}, {size.x, size.y, 1}});
}

std::span<const VoxelBox> BoneTextures::update(const Bone& bone, std::span<const BrickChange> changes) {
    if (copy_) changes = copy_->update(bone, changes);
    if (visible_) visible_->follow(copied(bone), changes);
    const Bone& drawn = shown(bone);
    changed_ = changed_boxes(drawn.content(), changes);
    for (const PlacedVoxels& placed : places_.that_show(drawn, changed_))
        upload_voxels(fraction_, drawn, BoneChannel::fraction, placed, scratch_);
    for (const VoxelBox& blocks : empty_space_.update(drawn, changes)) upload_blocks(blocks);
    if (smoothed_) smoothed_->update(drawn, places_, changed_);
    if (surface_) surface_->update(drawn, places_, changed_);
    return changed_;
}

std::vector<TextureSize> BoneTextures::sizes() const {
    std::vector<TextureSize> sizes{{"fractions", fraction_.bytes()}};
    if (colour_code_) sizes.push_back({"colour codes", colour_code_->bytes()});
    if (smoothed_) sizes.push_back({"smoothed fractions", smoothed_->texture().bytes()});
    if (surface_) sizes.push_back({"surface voxels", surface_->texture().bytes()});
    if (tile_table_) sizes.push_back({"tiles of bricks", tile_table_->bytes()});
    sizes.push_back({"empty space", blocks_.bytes()});
    return sizes;
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

glm::dvec3 BoneTextures::to_box_voxels(const glm::dvec3& position_mm) const {
    // A voxel's centre is at a whole number of grid coordinates and at a half in texture coordinates.
    return to_voxel_coordinates(grid_, position_mm) + 0.5 - glm::dvec3(box().first);
}

}  // namespace osteomill
