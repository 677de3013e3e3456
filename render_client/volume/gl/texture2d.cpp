#include "render_client/volume/gl/texture2d.h"

namespace osteomill::gl {

void Texture2D::store(const glm::ivec2& size, GLint stored_as, GLenum format, GLenum type, const void* texels,
                      GLint smaller, GLint larger) {
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, stored_as, size.x, size.y, 0, format, type, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, larger);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2D::end_at_edges() {
    glBindTexture(GL_TEXTURE_2D, id_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2D::upload(const Picture& picture) {
    store(picture.size_px, GL_RGBA8, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data(), GL_LINEAR, GL_NEAREST);
}

void Texture2D::upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba) {
    store(size_px, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data(), GL_LINEAR, GL_NEAREST);
}

void Texture2D::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, id_);
}

}  // namespace osteomill::gl
