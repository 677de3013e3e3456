#include "render_client/volume/passes/silhouettes.h"

#include <glm/common.hpp>

#include "render_client/volume/passes/raycast_renderer.h"

namespace osteomill {

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
                       const PixelBox& box, const PixelBox& near_bone) {
    drawn_->copy_to(target, box);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, size_px.x, size_px.y);
    if (near_bone.size.x <= 0 || near_bone.size.y <= 0) return;
    glScissor(near_bone.first.x, near_bone.first.y, near_bone.size.x, near_bone.size.y);
    const gl::Program& program = program_.use(bone, look);
    set_ray_uniforms(program, bone, camera, size_px, settings);
    constexpr int colour_unit = BoneProgram::first_free_unit;
    drawn_->bind_textures(colour_unit);
    program.set("drawn_colour", colour_unit);
    program.set("drawn_depth", colour_unit + 1);
    program.set("picture_size", glm::vec2(size_px));
    program.set("pixel_width", static_cast<float>(2.0 * camera.half_extent(size_px).y / size_px.y));
    // Depth stays, and no pixel hides another.
    const GLboolean tests_depth = glIsEnabled(GL_DEPTH_TEST);
    glDisable(GL_DEPTH_TEST);
    program.fill_picture();
    if (tests_depth == GL_TRUE) glEnable(GL_DEPTH_TEST);
}

}  // namespace osteomill
