// A picture in a texture, to be shown as it is. A move-only value. Every call needs the
// OpenGL context in which it was made to be current.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "render_client/volume/picture.h"

namespace osteomill::gl {

class PictureTexture {
  public:
    PictureTexture();
    PictureTexture(PictureTexture&& other) noexcept;
    PictureTexture& operator=(PictureTexture&& other) noexcept;
    ~PictureTexture();

    /// Rows from the top; 4 bytes a pixel.
    void upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba);
    void upload(const Picture& picture);
    GLuint id() const { return id_; }

  private:
    void store(const glm::ivec2& size_px, GLenum format, const std::uint8_t* bytes);

    GLuint id_ = 0;
};

}  // namespace osteomill::gl
