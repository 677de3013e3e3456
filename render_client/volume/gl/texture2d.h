// A 2D texture: a move-only value. Every call needs the OpenGL context in which it was made to be current.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "render_client/volume/gl/name.h"
#include "render_client/volume/picture.h"

namespace osteomill::gl {

class Texture2D {
  public:
    /// glTexImage2D, which replaces the texels: rows of `texels` follow one another without a gap, null
    /// leaves them undefined. The filter is `smaller` if a pixel covers several texels, else `larger`.
    void store(const glm::ivec2& size, GLint stored_as, GLenum format, GLenum type, const void* texels,
               GLint smaller, GLint larger);
    /// GL_CLAMP_TO_EDGE: beyond its edges the edges go on.
    void end_at_edges();
    /// A picture, to be shown as it is: rows from the top.
    void upload(const Picture& picture);
    void upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba);
    /// Binds to GL_TEXTURE0 + unit.
    void bind(int unit) const;
    GLuint id() const { return id_; }

  private:
    TextureName id_;
};

}  // namespace osteomill::gl
