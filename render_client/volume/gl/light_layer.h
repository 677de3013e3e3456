// Light gathered front to back: linear RGB times alpha, and alpha, in half floats, since many thin layers
// would drown in the steps of eight bits. A move-only value.
#pragma once

#include <glm/vec2.hpp>

#include "render_client/volume/gl/texture2d.h"

namespace osteomill::gl {

class LightLayer {
  public:
    /// Throws std::runtime_error if the driver cannot draw into such a picture.
    explicit LightLayer(const glm::ivec2& size_px);

    /// Clears the layer; later draw calls land here, each behind those before it (both within glScissor's
    /// part). Depth is neither tested nor written.
    void begin();
    /// Returns to the framebuffer that was bound before, without blending.
    void end();
    /// Binds the gathered light to GL_TEXTURE0 + unit.
    void bind_texture(int unit) const { colour_.bind(unit); }

    const glm::ivec2& size_px() const { return size_px_; }

  private:
    glm::ivec2 size_px_;
    FramebufferName id_;
    Texture2D colour_;
    GLint previous_ = 0;
};

}  // namespace osteomill::gl
