#include "render_client/volume/gl/graphics_devices.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <array>

namespace osteomill::gl {

namespace {

/// Whether a list of names, with blanks between them, holds this one.
bool lists(std::string_view names, std::string_view wanted) {
    while (!names.empty()) {
        const std::string_view name = names.substr(0, names.find(' '));
        if (name == wanted) return true;
        names.remove_prefix(std::min(name.size() + 1, names.size()));
    }
    return false;
}

}  // namespace

std::vector<GraphicsDevice> graphics_devices() {
    // Mesa lists the two halves of the extension, NVIDIA the whole.
    const auto has = [](const char* extension) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension); };
    if (!has("EGL_EXT_platform_device") ||
        !(has("EGL_EXT_device_base") || (has("EGL_EXT_device_enumeration") && has("EGL_EXT_device_query"))))
        return {};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(0, nullptr, &count) || count < 1) return {};
    std::vector<EGLDeviceEXT> listed(static_cast<std::size_t>(count));
    if (!eglQueryDevicesEXT(count, listed.data(), &count)) return {};
    listed.resize(static_cast<std::size_t>(count));
    std::vector<GraphicsDevice> devices;
    for (EGLDeviceEXT device : listed) {
        const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
        devices.push_back({device, extensions == nullptr ? "" : extensions});
    }
    return devices;
}

std::vector<GraphicsDevice> gpus_among(const std::vector<GraphicsDevice>& devices) {
    std::vector<GraphicsDevice> gpus;
    for (const GraphicsDevice& device : devices)
        if (!lists(device.extensions, "EGL_MESA_device_software")) gpus.push_back(device);
    return gpus;
}

bool is_software_renderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 3> rasterisers{"llvmpipe", "softpipe", "SWR"};
    return std::ranges::any_of(
        rasterisers, [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

}  // namespace osteomill::gl
