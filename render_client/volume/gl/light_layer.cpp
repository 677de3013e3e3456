#include "render_client/volume/gl/light_layer.h"

#include <stdexcept>
#include <string>

namespace osteomill::gl {

LightLayer::LightLayer(const glm::ivec2& size_px) : size_px_(size_px) {
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    colour_.store(size_px, GL_RGBA16F, GL_RGBA, GL_FLOAT, nullptr, GL_NEAREST, GL_NEAREST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id_);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
    const bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
    if (complete) return;
    throw std::runtime_error("the OpenGL driver cannot draw into a half-float picture of " +
                             std::to_string(size_px.x) + " x " + std::to_string(size_px.y) + " pixels");
}

void LightLayer::begin() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &previous_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id_);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
}

void LightLayer::end() {
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(previous_));
}

}  // namespace osteomill::gl
