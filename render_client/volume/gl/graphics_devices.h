// Graphics devices that EGL draws on without a display (EGL_EXT_platform_device).
//
// Asked for no device in particular, EGL takes the first driver that answers, and on a machine whose GPU has
// a driver of its own that may be Mesa's software rasteriser. So the GPUs are asked one by one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace osteomill::gl {

struct GraphicsDevice {
    void* egl_device = nullptr;
    std::string extensions{};  ///< EGL_EXTENSIONS of the device
};

/// All that EGL lists, the software rasteriser among them, in EGL's order; none where EGL cannot list them.
std::vector<GraphicsDevice> graphics_devices();

/// Those that are hardware, in the same order.
std::vector<GraphicsDevice> gpus_among(const std::vector<GraphicsDevice>& devices);

/// Whether GL_RENDERER names a software rasteriser: a device that only shows pictures is drawn on by one.
bool is_software_renderer(std::string_view renderer);

}  // namespace osteomill::gl
