// A microscope's round field of light over a picture: black beyond it, as seen through the eyepieces. Its
// lamp shines along the view, as a spot:
//
//     light = (1 - 0.45 r^2) min(focus / z, 1)^2
//
// with r the place in the field, 1 at its edge, and z the distance of the bone along the view. The focus is
// what the view turns about.
#pragma once

#include "render_client/volume/camera.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/program.h"

namespace osteomill {

class LightField {
  public:
    LightField();
    /// Draws into the bound framebuffer, which holds the picture of that camera and has the size of `bone`.
    /// The depth in `bone` decides the light of each pixel, also of a tool in front of the bone; a pixel
    /// without bone is lit as at the focus.
    void draw(const gl::Framebuffer& bone, const Camera& camera) const;

  private:
    gl::Program program_;
};

}  // namespace osteomill
