// An OpenGL 3.3 core context without a window or a display server (EGL): on the first GPU that has one, else
// on any device that draws without a surface, such as Mesa's software rasteriser. Made current in the
// constructor, on the calling thread; draw into a Framebuffer. A process may have several.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "render_client/volume/gl/second_context.h"

namespace osteomill::gl {

/// Error of a machine without OpenGL 3.3. The message says what was found and what to install.
struct NoOpenGl : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class OffscreenContext {
  public:
    /// `gpu`: only this one of the machine's GPUs, counted from 0 in EGL's order. Throws NoOpenGl.
    explicit OffscreenContext(std::optional<int> gpu = std::nullopt);
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;
    ~OffscreenContext();

    /// Makes it current on the calling thread; release() makes it current on none.
    void make_current() const;
    void release() const;

    /// A context that shares its textures and must not outlive it; null if the driver makes none.
    std::unique_ptr<SecondContext> second() const;

  private:
    bool starts_on(void* egl_device);
    void start_surfaceless();

    void* display_ = nullptr;
    void* context_ = nullptr;
};

/// GL_RENDERER and GL_VERSION of the current context ("llvmpipe (...), OpenGL 4.5 ...").
std::string renderer_name();

/// Throws NoOpenGl unless the current context offers at least OpenGL 3.3.
void require_opengl_3_3();

}  // namespace osteomill::gl
