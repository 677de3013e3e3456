#include "render_client/volume/gl/framebuffer.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace osteomill::gl {

Framebuffer::Framebuffer(const glm::ivec2& size_px) : size_px_(size_px) {
    colour_.store(size_px, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, nullptr, GL_LINEAR, GL_LINEAR);
    depth_.store(size_px, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr, GL_NEAREST,
                 GL_NEAREST);
    colour_.end_at_edges();
    depth_.end_at_edges();
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw std::runtime_error("the OpenGL driver cannot draw into a picture of " + std::to_string(size_px.x) +
                             " x " + std::to_string(size_px.y) + " pixels");
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glViewport(0, 0, size_px_.x, size_px_.y);
}

void Framebuffer::copy_to(GLuint target, const PixelBox& box) const {
    const glm::ivec2 end = box.first + box.size;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
    glBlitFramebuffer(box.first.x, box.first.y, end.x, end.y, box.first.x, box.first.y, end.x, end.y,
                      GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::copy_colour_to(const Framebuffer& target, const glm::ivec2& first) const {
    const glm::ivec2 end = first + size_px_;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.id_);
    glBlitFramebuffer(0, 0, size_px_.x, size_px_.y, first.x, first.y, end.x, end.y, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

void Framebuffer::copy_colour_to_window(GLenum buffer) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glDrawBuffer(buffer);
    glBlitFramebuffer(0, 0, size_px_.x, size_px_.y, 0, 0, size_px_.x, size_px_.y, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Framebuffer::bind_textures(int unit) const {
    colour_.bind(unit);
    depth_.bind(unit + 1);
}

Picture Framebuffer::read_back() const {
    Picture picture(size_px_);
    const auto row_bytes = static_cast<std::size_t>(size_px_.x) * 3;
    std::vector<std::uint8_t> bottom_up(picture.rgb.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size_px_.x, size_px_.y, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
    for (std::size_t row = 0; row < static_cast<std::size_t>(size_px_.y); ++row)
        std::copy_n(bottom_up.end() - static_cast<std::ptrdiff_t>((row + 1) * row_bytes), row_bytes,
                    picture.rgb.begin() + static_cast<std::ptrdiff_t>(row * row_bytes));
    return picture;
}

std::vector<float> Framebuffer::read_depth() const {
    const auto row = static_cast<std::size_t>(size_px_.x);
    std::vector<float> depth(row * static_cast<std::size_t>(size_px_.y));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glReadPixels(0, 0, size_px_.x, size_px_.y, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
    const auto at = [&](std::size_t y) { return depth.begin() + static_cast<std::ptrdiff_t>(y * row); };
    for (std::size_t low = 0, high = static_cast<std::size_t>(size_px_.y) - 1; low < high; ++low, --high)
        std::swap_ranges(at(low), at(low + 1), at(high));
    return depth;
}

float Framebuffer::depth_at(const glm::ivec2& pixel) const {
    float depth = 1.0f;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glReadPixels(pixel.x, pixel.y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    return depth;
}

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
