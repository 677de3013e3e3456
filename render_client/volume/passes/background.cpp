#include "render_client/volume/passes/background.h"

#include "render_client/volume/shaders/appearance_uniforms.h"
#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

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
