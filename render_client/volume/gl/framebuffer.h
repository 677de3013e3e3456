// A picture to draw into: RGBA8 colour and 32-bit float depth, with a texture each. A move-only value.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render_client/volume/camera.h"
#include "render_client/volume/gl/texture.h"
#include "render_client/volume/picture.h"

namespace osteomill::gl {

class Framebuffer {
  public:
    /// Throws std::runtime_error if the driver cannot draw into such a picture.
    explicit Framebuffer(const glm::ivec2& size_px);

    /// Draw calls that follow land here; the viewport becomes the whole picture.
    void bind() const;
    /// glBlitFramebuffer of colour and depth within a box; sizes must be equal.
    void copy_to(const Framebuffer& target, const PixelBox& box) const { copy_to(target.id_, box); }
    void copy_to(GLuint target, const PixelBox& box) const;
    /// glBlitFramebuffer of colour to another picture, the lower left corner to pixel `first` of it.
    void copy_colour_to(const Framebuffer& target, const glm::ivec2& first) const;
    /// glBlitFramebuffer of colour to the window's framebuffer, lower left corners together. `buffer` is one
    /// of the window's: GL_BACK, or GL_BACK_LEFT and GL_BACK_RIGHT if it has one for each eye.
    void copy_colour_to_window(GLenum buffer = GL_BACK) const;
    /// Binds the colour, read between pixels by linear interpolation, to GL_TEXTURE0 + unit, and the depth,
    /// not interpolated, to the next unit.
    void bind_textures(int unit) const;
    /// OpenGL's name of the colour, to draw it elsewhere.
    GLuint colour_texture() const { return colour_.id(); }
    /// glReadPixels of the colour; the first row is the top one.
    Picture read_back() const;
    /// glReadPixels of the depth (0 near to 1 far); the first row is the top one.
    std::vector<float> read_depth() const;
    /// Depth (0 near to 1 far) of a pixel counted from the lower left corner.
    float depth_at(const glm::ivec2& pixel) const;

    const glm::ivec2& size_px() const { return size_px_; }

  private:
    glm::ivec2 size_px_;
    FramebufferName id_;
    Texture2D colour_;
    Texture2D depth_;
};

/// Light gathered front to back: linear RGB times alpha, and alpha, in half floats, since many thin layers
/// would drown in the steps of eight bits. A move-only value.
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
