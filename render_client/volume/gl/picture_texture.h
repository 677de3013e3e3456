// A picture in a texture, to be shown as it is. A move-only value. Every call needs the
// OpenGL context in which it was made to be current.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "render_client/volume/gl/name.h"
#include "render_client/volume/picture.h"

namespace osteomill::gl {

class PictureTexture {
  public:
    /// Rows from the top; 4 bytes a pixel.
    void upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba);
    void upload(const Picture& picture);
    GLuint id() const { return id_; }

  private:
    void store(const glm::ivec2& size_px, GLenum format, const std::uint8_t* bytes);

    TextureName id_;
};

}  // namespace osteomill::gl
