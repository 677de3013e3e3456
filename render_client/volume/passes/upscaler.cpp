#include "render_client/volume/passes/upscaler.h"

#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

constexpr int colour_unit = 0;

}  // namespace

Upscaler::Upscaler() : program_(make_program(upscale_files)) {}

void Upscaler::draw(const gl::Framebuffer& coarse, const gl::Framebuffer& fine,
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
        program_.fill_picture();
    }
    glDisable(GL_SCISSOR_TEST);
    glDepthFunc(GL_LESS);
}

}  // namespace osteomill
