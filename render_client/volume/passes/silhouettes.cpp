#include "render_client/volume/passes/silhouettes.h"

#include <glm/common.hpp>

#include "render_client/volume/passes/raycast_renderer.h"

namespace osteomill {

namespace {

constexpr int block_edge_px = 8;  // as the shaders have it

/// The blocks that a box of the picture touches.
PixelBox blocks_of(const PixelBox& box) {
    const glm::ivec2 first = box.first / block_edge_px;
    const glm::ivec2 last = (box.first + box.size - 1) / block_edge_px;
    return {first, last - first + 1};
}

bool shows_bone(const SmoothedPart& part) {
    return part.near_bone.size.x > 0 && part.near_bone.size.y > 0;
}

float pixel_width(const Camera& camera, const glm::ivec2& size_px) {
    return static_cast<float>(2.0 * camera.half_extent(size_px).y / size_px.y);
}

}  // namespace

const gl::Framebuffer& Silhouettes::begin(const glm::ivec2& size_px) {
    // As large as any picture so far: coarse and fine ones take turns.
    const glm::ivec2 needed = drawn_ ? glm::max(size_px, drawn_->size_px()) : size_px;
    if (!drawn_ || drawn_->size_px() != needed) drawn_.emplace(needed);
    drawn_->bind();
    glViewport(0, 0, size_px.x, size_px.y);
    return *drawn_;
}

void Silhouettes::draw(const BoneTextures& bone, const Camera& camera, const SceneAppearance& look,
                       const RaycastSettings& settings, const glm::ivec2& size_px, GLuint target,
                       std::span<const SmoothedPart> parts) {
    // Depth stays, and no pixel hides another.
    const GLboolean tests_depth = glIsEnabled(GL_DEPTH_TEST);
    glDisable(GL_DEPTH_TEST);
    // A software rasteriser's copy waits until all is drawn, and so do the vertices, which read the blocks:
    // first everything is drawn, of all parts, so that they wait once.
    find_discontinuities(bone, camera, size_px, parts);
    for (const SmoothedPart& part : parts) {
        glScissor(part.box.first.x, part.box.first.y, part.box.size.x, part.box.size.y);
        drawn_->copy_to(target, part.box);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, size_px.x, size_px.y);
    search(bone, camera, look, settings, size_px, parts);
    if (tests_depth == GL_TRUE) glEnable(GL_DEPTH_TEST);
}

void Silhouettes::find_discontinuities(const BoneTextures& bone, const Camera& camera,
                                       const glm::ivec2& size_px, std::span<const SmoothedPart> parts) {
    const glm::ivec2 needed = blocks_of({{0, 0}, drawn_->size_px()}).size;
    if (!blocks_ || blocks_->size_px() != needed) blocks_.emplace(needed);
    blocks_->bind();
    block_program_.use();
    drawn_->bind_textures(0);
    block_program_.set("drawn_depth", 1);
    block_program_.set("picture_size", glm::vec2(size_px));
    block_program_.set("depth_terms", depth_terms(camera, bone.grid().spacing_mm, size_px));
    block_program_.set("pixel_width", pixel_width(camera, size_px));
    for (const SmoothedPart& part : parts) {
        if (!shows_bone(part)) continue;
        const PixelBox blocks = blocks_of(part.near_bone);
        glScissor(blocks.first.x, blocks.first.y, blocks.size.x, blocks.size.y);
        block_program_.fill_picture();
    }
}

void Silhouettes::search(const BoneTextures& bone, const Camera& camera, const SceneAppearance& look,
                         const RaycastSettings& settings, const glm::ivec2& size_px,
                         std::span<const SmoothedPart> parts) {
    const gl::Program& program = program_.use(bone, look);
    set_ray_uniforms(program, bone, camera, size_px, settings);
    constexpr int colour_unit = BoneProgram::first_free_unit;
    drawn_->bind_textures(colour_unit);
    program.set("drawn_colour", colour_unit);
    program.set("drawn_depth", colour_unit + 1);
    program.set("picture_size", glm::vec2(size_px));
    program.set("pixel_width", pixel_width(camera, size_px));
    blocks_->bind_textures(colour_unit + 2);
    program.set("discontinuity_blocks", colour_unit + 2);
    for (const SmoothedPart& part : parts) {
        if (!shows_bone(part)) continue;
        const PixelBox blocks = blocks_of(part.near_bone);
        glScissor(part.near_bone.first.x, part.near_bone.first.y, part.near_bone.size.x,
                  part.near_bone.size.y);
        program.set("first_block", glm::vec2(blocks.first));
        program.set("block_counts", glm::vec2(blocks.size));
        program.draw_triangles(2 * blocks.size.x * blocks.size.y);
    }
}

}  // namespace osteomill
