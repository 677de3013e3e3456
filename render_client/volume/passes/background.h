// The background of a picture, drawn first over all of it: the renderer then skips pixels without bone.
#pragma once

#include <glm/vec2.hpp>

#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_appearance.h"

namespace osteomill {

class Background {
  public:
    Background();
    /// Colour, and depth 1, over the viewport of `size_px`, within glScissor's part.
    void draw(const SceneAppearance& look, const glm::ivec2& size_px);

  private:
    gl::Program program_;
};

}  // namespace osteomill
