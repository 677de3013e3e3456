// An OpenGL 3.3 core context without a window or a display server (EGL, surfaceless platform). Made current
// in the constructor, on the calling thread; draw into a Framebuffer.
#pragma once

#include <stdexcept>
#include <string>

namespace osteomill::gl {

/// There is no OpenGL 3.3 here. The message says what was found and what to install.
struct NoOpenGl : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class OffscreenContext {
  public:
    /// Throws NoOpenGl.
    OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;
    ~OffscreenContext();

  private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

/// GL_RENDERER and GL_VERSION of the current context ("llvmpipe (...), OpenGL 4.5 ...").
std::string renderer_name();

/// Throws NoOpenGl unless the current context offers at least OpenGL 3.3.
void require_opengl_3_3();

}  // namespace osteomill::gl
