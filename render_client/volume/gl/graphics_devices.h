// Graphics devices that EGL draws on without a display (EGL_EXT_platform_device).
//
// Without a chosen device, EGL takes the first driver that answers. On a machine whose GPU has a driver of
// its own that may be Mesa's software rasteriser. So the GPUs are tried one by one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace osteomill::gl {

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
