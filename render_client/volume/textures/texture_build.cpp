#include "render_client/volume/textures/texture_build.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "common/bone/structure_mask.h"

namespace osteomill {

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
