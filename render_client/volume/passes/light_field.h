// A microscope's round field of light over a picture: black beyond it, as seen through the eyepieces.
#pragma once

#include "render_client/volume/gl/program.h"

namespace osteomill {

class LightField {
  public:
    LightField();
    /// Draws into the bound framebuffer.
    void draw(const glm::ivec2& size_px, double pixel_aspect) const;

  private:
    gl::Program program_;
};

}  // namespace osteomill
