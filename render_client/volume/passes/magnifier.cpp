#include "render_client/volume/passes/magnifier.h"

namespace osteomill {

namespace {

constexpr const char* vertex_glsl = R"glsl(#version 330 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)glsl";

constexpr const char* fragment_glsl = R"glsl(#version 330 core
uniform sampler2D colour, depth;
uniform vec2 picture_size;
out vec4 pixel;

void main() {
    vec2 place = gl_FragCoord.xy / picture_size;
    pixel = textureLod(colour, place, 0.0);
    gl_FragDepth = textureLod(depth, place, 0.0).r;
}
)glsl";

constexpr int colour_unit = 0;

}  // namespace

Magnifier::Magnifier() : program_(vertex_glsl, fragment_glsl) {}

void Magnifier::draw(const gl::Framebuffer& coarse, const gl::Framebuffer& fine,
                     std::span<const PixelBox> boxes) const {
    fine.bind();
    coarse.bind_textures(colour_unit);
    program_.use();
    program_.set("colour", colour_unit);
    program_.set("depth", colour_unit + 1);
    program_.set("picture_size", glm::vec2(fine.size_px()));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glEnable(GL_SCISSOR_TEST);
    for (const PixelBox& box : boxes) {
        glScissor(box.first.x, box.first.y, box.size.x, box.size.y);
        full_screen_.draw();
    }
    glDisable(GL_SCISSOR_TEST);
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
