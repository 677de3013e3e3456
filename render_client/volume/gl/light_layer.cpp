#include "render_client/volume/gl/light_layer.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace osteomill::gl {

LightLayer::LightLayer(const glm::ivec2& size_px) : size_px_(size_px) {
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    glGenTextures(1, &colour_);
    glBindTexture(GL_TEXTURE_2D, colour_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, size_px.x, size_px.y, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &id_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id_);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    const bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
    if (complete) return;
    glDeleteFramebuffers(1, &id_);
    glDeleteTextures(1, &colour_);
    throw std::runtime_error("the OpenGL driver cannot draw into a half-float picture of " +
                             std::to_string(size_px.x) + " x " + std::to_string(size_px.y) + " pixels");
}

LightLayer::LightLayer(LightLayer&& other) noexcept
    : size_px_(other.size_px_),
      id_(std::exchange(other.id_, 0)),
      colour_(std::exchange(other.colour_, 0)),
      previous_(other.previous_) {}

LightLayer& LightLayer::operator=(LightLayer&& other) noexcept {
    std::swap(size_px_, other.size_px_);
    std::swap(id_, other.id_);
    std::swap(colour_, other.colour_);
    std::swap(previous_, other.previous_);
    return *this;
}

LightLayer::~LightLayer() {
    if (id_ != 0) glDeleteFramebuffers(1, &id_);
    if (colour_ != 0) glDeleteTextures(1, &colour_);
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

void LightLayer::bind_texture(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, colour_);
}

}  // namespace osteomill::gl
