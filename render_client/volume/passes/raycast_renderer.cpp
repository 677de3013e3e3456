#include "render_client/volume/passes/raycast_renderer.h"

#include <array>
#include <glm/common.hpp>
#include <optional>
#include <vector>

#include "render_client/volume/shaders/appearance_uniforms.h"

namespace osteomill {

namespace {

PixelBox scissor_box() {
    std::array<GLint, 4> box{};
    glGetIntegerv(GL_SCISSOR_BOX, box.data());
    return {{box[0], box[1]}, {box[2], box[3]}};
}

PixelBox common_part(const PixelBox& a, const PixelBox& b) {
    const glm::ivec2 first = glm::max(a.first, b.first);
    return {first, glm::max(glm::min(a.first + a.size, b.first + b.size) - first, 0)};
}

/// Pixels that show bone, and one more on each side for silhouettes.
PixelBox pixels_beside(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    const Grid& grid = bone.grid();
    const VoxelBox& box = bone.box();
    const std::optional<PixelBox> seen =
        pixels_of_box(camera, centre_of_voxel_mm(grid, box.first) - grid.spacing_mm,
                      centre_of_voxel_mm(grid, box.first + box.size - 1) + grid.spacing_mm, size_px);
    return seen ? PixelBox{seen->first - 1, seen->size + 2} : PixelBox{{0, 0}, size_px};
}

}  // namespace

glm::vec2 depth_terms(const Camera& camera, double spacing_mm, const glm::ivec2& size_px) {
    const glm::dmat4 projection = camera.projection(size_px);
    return {0.5 - 0.5 * projection[2][2], 0.5 * projection[3][2] / spacing_mm};
}

void set_ray_uniforms(const gl::Program& program, const BoneTextures& bone, const Camera& camera,
                      const glm::ivec2& size_px, const RaycastSettings& settings) {
    const glm::dvec2 half_extent = camera.half_extent(size_px);
    program.set("step_length", settings.step_voxels);
    program.set("skips", settings.skipping == EmptySpaceSkipping::distance_map ? 1 : 0);
    program.set("forward", glm::vec3(camera.forward()));
    program.set("middle_ray", glm::vec3(camera.middle_ray()));
    program.set("right", glm::vec3(half_extent.x * camera.right()));
    program.set("up", glm::vec3(half_extent.y * camera.up()));
    program.set("eye", glm::vec3(bone.to_box_voxels(camera.eye_mm())));
    program.set("depth_terms", depth_terms(camera, bone.grid().spacing_mm, size_px));
}

RaycastRenderer::RaycastRenderer(const RaycastSettings& settings)
    : bone_program_(raycast_files), settings_(settings) {}

bool RaycastRenderer::smooths(const BoneTextures& bone) const {
    return look().smooth_silhouettes && !bone.is_translucent();
}

void RaycastRenderer::draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    if (!smooths(bone)) return draw_rays(bone, camera, size_px);
    const bool is_part = glIsEnabled(GL_SCISSOR_TEST) == GL_TRUE;
    const PixelBox box = is_part ? scissor_box() : PixelBox{{0, 0}, size_px};
    glEnable(GL_SCISSOR_TEST);
    draw_smooth(bone, camera, size_px, {&box, 1});
    glScissor(box.first.x, box.first.y, box.size.x, box.size.y);
    if (!is_part) glDisable(GL_SCISSOR_TEST);
}

void RaycastRenderer::draw_parts(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                                 std::span<const PixelBox> parts) {
    if (!smooths(bone)) return BoneRenderer::draw_parts(bone, camera, size_px, parts);
    glEnable(GL_SCISSOR_TEST);
    draw_smooth(bone, camera, size_px, parts);
    glDisable(GL_SCISSOR_TEST);
}

/// The scissor test is on.
void RaycastRenderer::draw_smooth(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                                  std::span<const PixelBox> parts) {
    GLint target = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    if (!silhouettes_) silhouettes_.emplace();
    silhouettes_->begin(size_px);
    const PixelBox whole{{0, 0}, size_px};
    const PixelBox seen = pixels_beside(bone, camera, size_px);
    std::vector<SmoothedPart> smoothed;
    for (const PixelBox& part : parts) {
        const PixelBox box = common_part(part, whole);
        smoothed.push_back({.box = box, .near_bone = common_part(box, seen)});
        // Silhouettes at the edge of a part depend on the pixel beyond it.
        const PixelBox grown = common_part({box.first - 1, box.size + 2}, whole);
        glScissor(grown.first.x, grown.first.y, grown.size.x, grown.size.y);
        draw_rays(bone, camera, size_px);
    }
    silhouettes_->draw(bone, camera, look(), settings_, size_px, static_cast<GLuint>(target), smoothed);
}

void RaycastRenderer::draw_rays(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    background_.draw(look(), size_px);
    const gl::Program& program = bone_program_.use(bone, look());
    set_ray_uniforms(program, bone, camera, size_px, settings_);
    program.set("picture_size", glm::vec2(size_px));
    set_background_uniforms(program, look());
    set_grain_uniforms(program, bone, camera, size_px);

    // Bone that is seen through has the background's depth.
    glDepthFunc(GL_LEQUAL);
    program.fill_picture();
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
