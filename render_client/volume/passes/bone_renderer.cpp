#include "render_client/volume/passes/bone_renderer.h"

#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/slice_renderer.h"
#include "render_client/volume/shaders/appearance_uniforms.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

std::unique_ptr<BoneRenderer> make_renderer(RendererChoice choice) {
    if (choice == RendererChoice::slices) return std::make_unique<SliceRenderer>();
    return std::make_unique<RaycastRenderer>();
}

Background::Background() : program_(make_program(background_files)) {}

void Background::draw(const SceneAppearance& look, const glm::ivec2& size_px) {
    program_.use();
    program_.set("picture_size", glm::vec2(size_px));
    set_background_uniforms(program_, look);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    program_.fill_picture();
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
