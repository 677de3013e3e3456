// A draw call that covers every pixel of the viewport: a vertex array without attributes, a move-only value.
// The vertex shader makes one large triangle from gl_VertexID.
#pragma once

#include <epoxy/gl.h>

namespace osteomill::gl {

class FullScreen {
  public:
    FullScreen();
    FullScreen(FullScreen&& other) noexcept;
    FullScreen& operator=(FullScreen&& other) noexcept;
    ~FullScreen();

    void draw() const;

  private:
    GLuint array_ = 0;
};

}  // namespace osteomill::gl
