#include "render_client/volume/passes/background.h"

#include <string>

#include "render_client/volume/shaders/lighting.h"
#include "render_client/volume/shaders/look_shader.h"

namespace osteomill {

namespace {

constexpr const char* background_fragment_glsl = R"glsl(
uniform vec2 picture_size;
out vec4 pixel;

void main() { pixel = vec4(display(background_at(gl_FragCoord.xy / picture_size)), 1.0); }
)glsl";

}  // namespace

Background::Background()
    : program_(whole_picture_vertex_glsl, std::string("#version 330 core\n") + lighting_glsl +
                                              background_glsl + background_fragment_glsl) {}

void Background::draw(const SceneLook& look, const glm::ivec2& size_px) {
    program_.use();
    program_.set("picture_size", glm::vec2(size_px));
    set_background_uniforms(program_, look);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    full_screen_.draw();
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
