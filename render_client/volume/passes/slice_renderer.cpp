#include "render_client/volume/passes/slice_renderer.h"

#include <glm/ext/matrix_transform.hpp>

#include "render_client/volume/passes/view_slices.h"
#include "render_client/volume/shaders/appearance_uniforms.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

constexpr int light_unit = 0;  // no bone is sampled beside it

/// From voxels of the textures to patient space.
glm::dmat4 to_patient(const BoneTextures& bone) {
    const Grid& grid = bone.grid();
    const glm::dvec3 corner_mm =
        centre_of_voxel_mm(grid, bone.box().first) - glm::dvec3(0.5 * grid.spacing_mm);
    return glm::scale(glm::translate(glm::dmat4(1.0), corner_mm), glm::dvec3(grid.spacing_mm));
}

}  // namespace

SliceRenderer::SliceRenderer(const SliceSettings& settings)
    : settings_(settings), slice_program_(slice_files), blend_program_(make_program(gathered_light_files)) {}

void SliceRenderer::draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    // One voxel beyond the box on every side the fraction has fallen to zero.
    slices_.upload(view_slices(glm::dvec3(-1.0), glm::dvec3(bone.box().size) + 1.0,
                               bone.to_box_voxels(camera.eye_mm()), camera.forward(),
                               settings_.spacing_voxels));
    background_.draw(look(), size_px);
    if (bone.is_translucent())
        draw_translucent(bone, camera, size_px);
    else
        draw_slices(bone, camera, size_px, Pass::solid);
}

void SliceRenderer::draw_slices(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                                Pass pass) {
    const gl::Program& program = slice_program_.use(bone, look());
    program.set("to_clip", glm::mat4(camera.projection(size_px) * camera.view() * to_patient(bone)));
    program.set("eye", glm::vec3(bone.to_box_voxels(camera.eye_mm())));
    program.set("forward", glm::vec3(camera.forward()));
    program.set("spacing", settings_.spacing_voxels);
    program.set("drawn_pass", static_cast<int>(pass));
    set_grain_uniforms(program, bone, camera, size_px);
    slices_.draw();
}

void SliceRenderer::draw_translucent(const BoneTextures& bone, const Camera& camera,
                                     const glm::ivec2& size_px) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_slices(bone, camera, size_px, Pass::depth);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    if (!light_ || light_->size_px() != size_px) light_.emplace(size_px);
    light_->begin();
    draw_slices(bone, camera, size_px, Pass::light);
    light_->end();

    blend_program_.use();
    blend_program_.set("light", light_unit);
    blend_program_.set("picture_size", glm::vec2(size_px));
    set_background_uniforms(blend_program_, look());
    light_->bind_texture(light_unit);
    glDisable(GL_DEPTH_TEST);
    blend_program_.fill_picture();
    glEnable(GL_DEPTH_TEST);
}

}  // namespace osteomill
