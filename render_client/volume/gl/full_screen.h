// A draw call that covers every pixel of the viewport: a vertex array without attributes, a move-only value.
// The vertex shader makes one large triangle from gl_VertexID.
#pragma once

#include "render_client/volume/gl/name.h"

namespace osteomill::gl {

class FullScreen {
  public:
    void draw() const;

  private:
    VertexArrayName array_;
};

}  // namespace osteomill::gl
