// A coarse picture upscaled into a finer one: colour interpolated, depth not, so that bone still hides the
// parts of later drawings behind it.
#pragma once

#include <span>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/program.h"

namespace osteomill {

class Upscaler {
  public:
    Upscaler();
    /// Fills these boxes of `fine` with those of `coarse`; both show the same view.
    void draw(const gl::Framebuffer& coarse, const gl::Framebuffer& fine,
              std::span<const PixelBox> boxes) const;

  private:
    gl::Program program_;
};

}  // namespace osteomill
