#include "render_client/volume/gl/picture_texture.h"

namespace osteomill::gl {

void PictureTexture::upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba) {
    store(size_px, GL_RGBA, rgba.data());
}

void PictureTexture::upload(const Picture& picture) {
    store(picture.size_px, GL_RGB, picture.rgb.data());
}

void PictureTexture::store(const glm::ivec2& size_px, GLenum format, const std::uint8_t* bytes) {
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_px.x, size_px.y, 0, format, GL_UNSIGNED_BYTE, bytes);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace osteomill::gl
