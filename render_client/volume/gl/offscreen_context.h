// An OpenGL 3.3 core context without a window or a display server (EGL): on the first GPU that has one, else
// on any device that draws without a surface, such as Mesa's software rasteriser. Made current in the
// constructor, on the calling thread; draw into a Framebuffer. A process may have several.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "render_client/volume/gl/storage_thread.h"

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

/// Graphics devices that EGL draws on without a display (EGL_EXT_platform_device).
///
/// Without a chosen device, EGL takes the first driver that answers. On a machine whose GPU has a driver of
/// its own that may be Mesa's software rasteriser. So the GPUs are tried one by one.
struct GraphicsDevice {
    void* egl_device = nullptr;
    std::string extensions{};  ///< EGL_EXTENSIONS of the device
};

/// All devices that EGL lists, the software rasteriser included, in EGL's order; empty if EGL cannot list
/// them.
std::vector<GraphicsDevice> graphics_devices();

/// The hardware devices among them, in the same order.
std::vector<GraphicsDevice> gpus_among(const std::vector<GraphicsDevice>& devices);

/// Whether GL_RENDERER names a software rasteriser, as on a device that can only show pictures.
bool is_software_renderer(std::string_view renderer);

}  // namespace osteomill::gl
