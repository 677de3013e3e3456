#include "render_client/volume/textures/bone_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <stdexcept>
#include <utility>

#include "common/bone/structure_mask.h"
#include "render_client/volume/textures/voxel_codes.h"

namespace osteomill {

namespace {

constexpr int farthest_shown = 127, has_one_code_bit = 128;  // as bone_sampling.glsl has them

void upload_voxels(gl::Texture3D& texture, const Bone& bone, BoneChannel channel, const PlacedVoxels& placed,
                   std::vector<std::uint8_t>& scratch) {
    scratch.resize(placed.voxels.count());
    copy_channel(bone, channel, placed.voxels, scratch);
    texture.upload(placed.first_texel, placed.voxels.size, scratch);
}

/// Waits for a texture in steps that leave the processor to others.
Steps arrival(std::future<gl::Texture3D>& texture) {
    while (texture.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) co_yield 0.0;
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
    : BoneTextures(TextureBuild(bone, {tissues.begin(), tissues.end()}, look, limits).all_at_once()) {}

BoneTextures::BoneTextures(const Bone& bone, std::optional<CoarseBone> copy, const TransferTable& table,
                           Shading shading, const TexturePlan& plan, int longest_edge_texels)
    : plan_(plan),
      table_(table),
      shading_(shading),
      copy_(std::move(copy)),
      grid_(copied(bone).grid()),
      places_(copied(bone).content(), plan.layout, longest_edge_texels),
      empty_space_(places_.box()) {
    std::vector<glm::vec4> looks(table_.by_code.begin(), table_.by_code.end());
    for (const glm::vec2& grain : table_.grain_by_code) looks.emplace_back(grain, 0.0f, 0.0f);
    colours_.store({256, 2}, GL_RGBA32F, GL_RGBA, GL_FLOAT, looks.data(), GL_NEAREST, GL_NEAREST);
}

Steps BoneTextures::fill(const Bone& bone, gl::StorageThread* storage) {
    // All are requested first; work that needs no texture is done meanwhile.
    const glm::ivec3 texels = places_.texture_size();
    auto fraction = make_texture(storage, gl::VoxelFormat::interpolated_byte, texels);
    auto blocks = make_texture(storage, gl::VoxelFormat::interpolated_bytes, empty_space_.size_blocks());
    std::future<gl::Texture3D> code, smoothed, surface, seen;
    if (table_.codes.exist()) code = make_texture(storage, gl::VoxelFormat::byte_code, texels);
    if (plan_.smoothed) smoothed = make_texture(storage, gl::VoxelFormat::interpolated_byte, texels);
    if (shading_ == Shading::surface_voxels)
        surface = make_texture(storage, gl::VoxelFormat::interpolated_rgba, texels);
    if (table_.seen)
        seen = make_texture(storage, gl::VoxelFormat::interpolated_bytes, SeenLattice(box()).places);

    if (hides_bone(table_)) {
        visible_.emplace(table_);
        for (Steps part = visible_->fill(copied(bone)); part.step();) co_yield part_of(part, 0.0, 0.1);
    }
    const Bone& drawn = shown(bone);
    for (Steps part = empty_space_.fill(drawn); part.step();) co_yield part_of(part, 0.1, 0.4);
    for (int axis = 0; axis < 3; ++axis) {
        find_sawn_faces(drawn, axis, sawn_faces_);
        co_yield 0.4;
    }
    tile_table_ = upload_tile_table(drawn.content(), places_);
    // Bone that is seen through has no surface whose look is blended.
    if (codes_are_mostly_alike() && !is_translucent())
        for (Steps part = find_blocks_of_one_code(drawn); part.step();) co_yield 0.4;

    for (Steps wait = arrival(blocks); wait.step();) co_yield 0.4;
    blocks_ = blocks.get();
    blocks_->end_at_edges();  // its outermost blocks lie beyond the box, and hold no bone
    const glm::ivec3 size = empty_space_.size_blocks();
    for (int z = 0; z < size.z; ++z) {
        upload_blocks({{0, 0, z}, {size.x, size.y, 1}});
        co_yield 0.4 + 0.1 * z / size.z;
    }
    for (Steps wait = arrival(fraction); wait.step();) co_yield 0.5;
    fraction_ = fraction.get();
    const auto upload_fractions = [&](const PlacedVoxels& placed) {
        upload_voxels(*fraction_, drawn, BoneChannel::fraction, placed, scratch_);
    };
    for (Steps part = for_all(drawn, upload_fractions); part.step();) co_yield part_of(part, 0.5, 0.6);
    if (table_.codes.exist()) {
        for (Steps wait = arrival(code); wait.step();) co_yield 0.6;
        colour_code_ = code.get();
        const auto upload_codes = [&](const PlacedVoxels& placed) {
            scratch_.resize(placed.voxels.count());
            copy_codes(drawn, table_.codes, placed.voxels, scratch_);
            colour_code_->upload(placed.first_texel, placed.voxels.size, scratch_);
        };
        for (Steps part = for_all(drawn, upload_codes); part.step();) co_yield part_of(part, 0.6, 0.7);
    }
    if (plan_.smoothed) {
        for (Steps wait = arrival(smoothed); wait.step();) co_yield 0.7;
        smoothed_.emplace(table_, smoothed.get());
        for (Steps part = smoothed_->fill(drawn, places_); part.step();)
            co_yield part_of(part, 0.7, table_.seen ? 0.9 : 1.0);
    }
    if (table_.seen) {
        for (Steps wait = arrival(seen); wait.step();) co_yield 0.9;
        seen_.emplace(SeenLattice(box()), grid_.spacing_mm, *table_.seen, seen.get());
        store_seen_looks();
        for (Steps part = seen_->fill(drawn); part.step();) co_yield part_of(part, 0.9, 1.0);
    }
    if (shading_ == Shading::surface_voxels) {
        for (Steps wait = arrival(surface); wait.step();) co_yield 0.7;
        surface_.emplace(table_, surface.get());
        for (Steps part = surface_->fill(drawn, places_); part.step();) co_yield part_of(part, 0.7, 1.0);
    }
}

void BoneTextures::store_seen_looks() {
    const std::size_t numbers = table_.seen->size();
    std::vector<glm::u8vec4> looks(2 * numbers);
    const auto as_bytes = [](const glm::vec4& parts) {
        return glm::u8vec4(glm::round(255.0f * glm::clamp(parts, 0.0f, 1.0f)));
    };
    for (std::size_t label = 0; label < numbers; ++label) {
        const std::uint8_t number = seen_->number_of(static_cast<std::uint8_t>(label));
        if (number == 0) continue;
        const SeenTissue& tissue = (*table_.seen)[label];
        looks[number] = as_bytes(glm::vec4(glm::sqrt(tissue.colour), tissue.strength));
        const double depth = seen_->depth_voxels(tissue) / seen_->farthest_voxels();
        looks[numbers + number] = as_bytes(glm::vec4(static_cast<float>(depth)));
    }
    seen_looks_.store({256, 2}, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, looks.data(), GL_NEAREST, GL_NEAREST);
}

void BoneTextures::add_structure(std::uint8_t label, StructureMask structure) {
    if (seen_) seen_->add(label, std::move(structure), plan_.coarsening);
}

std::span<const VoxelBox> BoneTextures::work(const Bone& bone) {
    changed_.clear();
    if (seen_)
        if (const VoxelBox changed = seen_->work(shown(bone)); changed.count() > 0)
            changed_.push_back(changed);
    return changed_;
}

Steps BoneTextures::for_all(const Bone& drawn, std::function<void(const PlacedVoxels&)> upload) {
    const std::vector<PlacedVoxels> all = places_.all(drawn.content());
    for (std::size_t region = 0; region < all.size(); ++region) {
        upload(all[region]);
        co_yield static_cast<double>(region) / static_cast<double>(all.size());
    }
}

std::span<const VoxelBox> BoneTextures::update(const Bone& bone, std::span<const BrickChange> changes) {
    if (copy_) changes = copy_->update(bone, changes);
    if (visible_) visible_->follow(copied(bone), changes);
    const Bone& drawn = shown(bone);
    changed_ = changed_boxes(drawn.content(), changes);
    for (const PlacedVoxels& placed : places_.that_show(drawn, changed_))
        upload_voxels(*fraction_, drawn, BoneChannel::fraction, placed, scratch_);
    for (const VoxelBox& blocks : empty_space_.update(drawn, changes)) upload_blocks(blocks);
    if (smoothed_) smoothed_->update(drawn, places_, changed_);
    if (surface_) surface_->update(drawn, places_, changed_);
    if (seen_) {
        const std::span<const VoxelBox> seen = seen_->update(drawn, changes);
        changed_.insert(changed_.end(), seen.begin(), seen.end());
    }
    return changed_;
}

std::vector<TextureSize> BoneTextures::sizes() const {
    std::vector<TextureSize> sizes{{"fractions", fraction_->bytes()}};
    if (colour_code_) sizes.push_back({"colour codes", colour_code_->bytes()});
    if (smoothed_) sizes.push_back({"smoothed fractions", smoothed_->texture().bytes()});
    if (surface_) sizes.push_back({"surface voxels", surface_->texture().bytes()});
    if (seen_) sizes.push_back({"what thin bone shows", seen_->texture().bytes()});
    if (tile_table_) sizes.push_back({"tiles of bricks", tile_table_->bytes()});
    sizes.push_back({"empty space", blocks_->bytes()});
    return sizes;
}

Steps BoneTextures::find_blocks_of_one_code(const Bone& drawn) {
    has_one_code_.resize(empty_space_.distance().size());
    for (const BrickIndex index : drawn.content().brick_of_slot) {
        const glm::ivec3 brick = brick_position(drawn.content().size_bricks, index);
        const auto are_one = blocks_of_one_code(drawn, table_.codes, brick);
        for (std::size_t number = 0; number < blocks_per_brick; ++number)
            has_one_code_[empty_space_.index(empty_space_.block_of(brick, number))] = are_one[number];
        co_yield 0.0;
    }
}

void BoneTextures::upload_blocks(const VoxelBox& blocks) {
    scratch_.resize(2 * blocks.count());
    std::uint8_t* texel = scratch_.data();
    for (int z = blocks.first.z; z < blocks.first.z + blocks.size.z; ++z)
        for (int y = blocks.first.y; y < blocks.first.y + blocks.size.y; ++y) {
            std::size_t block = empty_space_.index({blocks.first.x, y, z});
            for (int x = 0; x < blocks.size.x; ++x, ++block) {
                *texel++ = empty_space_.mean_fraction()[block];
                const bool has_one_code = !has_one_code_.empty() && has_one_code_[block];
                *texel++ =
                    static_cast<std::uint8_t>(std::min<int>(empty_space_.distance()[block], farthest_shown) +
                                              (has_one_code ? has_one_code_bit : 0));
            }
        }
    blocks_->upload(blocks.first, blocks.size, scratch_);
}

glm::dvec3 BoneTextures::to_box_voxels(const glm::dvec3& position_mm) const {
    // A voxel's centre is at a whole number of grid coordinates and at a half in texture coordinates.
    return to_voxel_coordinates(grid_, position_mm) + 0.5 - glm::dvec3(box().first);
}

namespace {

VoxelBytes bytes_per_voxel(const TransferTable& table, Shading shading) {
    const bool published = shading == Shading::surface_voxels;
    return {.needed = std::size_t{1} + (table.codes.exist() ? 1 : 0) + (published ? sizeof(SurfaceTexel) : 0),
            .smoothed = published ? std::size_t{0} : std::size_t{1},
            .seen_through = table.seen.has_value()};
}

}  // namespace

TextureBuild::TextureBuild(const Bone& bone, std::vector<TissueColour> tissues, const ShadingSettings& look,
                           const TextureLimits& limits, gl::StorageThread* storage)
    : tissues_(std::move(tissues)), look_(look), limits_(limits), storage_(storage), steps_(build(bone)) {
    if (look.transfer) require_valid(*look.transfer);
}

BoneTextures TextureBuild::all_at_once() {
    while (step()) {
    }
    return take();
}

Steps TextureBuild::build(const Bone& bone) {
    if (bone.stored_bricks() == 0) throw std::runtime_error("the bone has no voxel to draw");
    for (Steps part = make_absent_opaque(bone); part.step();) co_yield 0.0;
    const TransferTable table = transfer_table(bone.content(), tissues_, look_);
    if (!limits_.longest_edge_texels) limits_.longest_edge_texels = gl::max_texture3d_edge();
    std::string refusal = fmt::format("the limit is {} MiB of textures of at most {} texels an edge",
                                      limits_.budget_bytes >> 20U, *limits_.longest_edge_texels);
    const std::vector<TexturePlan> plans =
        texture_plans(bone.content(), bytes_per_voxel(table, look_.shading), limits_);
    for (const TexturePlan& plan : plans) {
        plan_ = plan;
        co_yield 0.0;
        try {
            std::optional<CoarseBone> copy;
            if (plan.coarsening > 1) {
                copy.emplace(plan.coarsening);
                for (Steps part = copy->fill(bone); part.step();) co_yield part_of(part, 0.0, 0.2);
            }
            const double before = copy ? 0.2 : 0.0;
            made_ =
                BoneTextures(bone, std::move(copy), table, look_.shading, plan, *limits_.longest_edge_texels);
            for (Steps part = made_->fill(bone, storage_); part.step();) co_yield part_of(part, before, 1.0);
            co_return;
        } catch (const gl::NoTextureMemory& error) {
            refusal = error.what();
            has_settled_for_less_ = true;
        }
    }
    throw std::runtime_error(fmt::format(
        "the bone's {} bricks of 16^3 voxels exceed the graphics memory, even {} times coarser: {}",
        bone.stored_bricks(), coarsest, refusal));
}

Steps TextureBuild::make_absent_opaque(const Bone& bone) {
    for (TissueColour& tissue : tissues_) {
        if (tissue.opacity >= 1.0) continue;
        bool is_there = false;
        for (std::size_t slot = 0; slot < bone.content().tissue.size() && !is_there; ++slot) {
            is_there = brick_has_label(bone, slot, tissue.label);
            co_yield 0.0;
        }
        if (!is_there) tissue.opacity = 1.0;
    }
}

}  // namespace osteomill
