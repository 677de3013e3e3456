#include "render_client/volume/gl/offscreen_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace osteomill::gl {

namespace {

constexpr const char* what_to_install =
    "install a graphics driver, or Mesa's software one: apt-get install libgl1-mesa-dri libegl1";

[[noreturn]] void fail(const std::string& found) {
    throw NoOpenGl(fmt::format("no OpenGL 3.3 without a display: {}; {}", found, what_to_install));
}

EGLDisplay surfaceless_display() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        fail("EGL here has no surfaceless platform");
    // Not eglGetPlatformDisplay: libepoxy aborts on it if EGL is older than 1.5.
    EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
        fail("EGL's surfaceless platform does not start");
    return display;
}

EGLContext make_context(EGLDisplay display, EGLContext shares_with = EGL_NO_CONTEXT) {
    // Without it the surface type would be a window's, which no surfaceless configuration has.
    constexpr std::array<EGLint, 5> config_attributes{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                                      EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array<EGLint, 7> context_attributes{EGL_CONTEXT_MAJOR_VERSION,
                                                       3,
                                                       EGL_CONTEXT_MINOR_VERSION,
                                                       3,
                                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                       EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
    if (!eglChooseConfig(display, config_attributes.data(), &config, 1, &configs) || configs < 1)
        return EGL_NO_CONTEXT;
    return eglCreateContext(display, config, shares_with, context_attributes.data());
}

class SecondEglContext final : public SecondContext {
  public:
    SecondEglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    ~SecondEglContext() override { eglDestroyContext(display_, context_); }
    SecondEglContext(const SecondEglContext&) = delete;
    SecondEglContext& operator=(const SecondEglContext&) = delete;

    void make_current() override {
        eglBindAPI(EGL_OPENGL_API);
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    }
    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  private:
    EGLDisplay display_;
    EGLContext context_;
};

/// The text of what EGL offers if it is not OpenGL 3.3.
std::string offered_opengl(EGLDisplay display) {
    constexpr std::array<EGLint, 3> config_attributes{EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!eglChooseConfig(display, config_attributes.data(), &config, 1, &configs) || configs < 1)
        return "EGL offers no OpenGL at all";
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (context == EGL_NO_CONTEXT) return "EGL offers no OpenGL at all";
    std::string found = "EGL offers an OpenGL that needs a surface";
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        found = "EGL offers " + renderer_name();
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    return found;
}

}  // namespace

OffscreenContext::OffscreenContext(std::optional<int> gpu) {
    if (!epoxy_has_egl()) fail("libEGL.so.1 is missing");
    const std::vector<GraphicsDevice> gpus = gpus_among(graphics_devices());
    if (gpu) {
        if (*gpu < 0 || static_cast<std::size_t>(*gpu) >= gpus.size())
            throw NoOpenGl(gpus.empty()
                               ? fmt::format("GPU {}: EGL lists none", *gpu)
                               : fmt::format("GPU {}: EGL lists {}, counted from 0", *gpu, gpus.size()));
        if (!starts_on(gpus[static_cast<std::size_t>(*gpu)].egl_device))
            throw NoOpenGl(fmt::format("GPU {}: it draws no OpenGL 3.3 without a display", *gpu));
        return;
    }
    for (const GraphicsDevice& each : gpus)
        if (starts_on(each.egl_device)) return;
    start_surfaceless();
}

bool OffscreenContext::starts_on(void* egl_device) {
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, egl_device, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) return false;
    context_ = make_context(display_);
    if (context_ != EGL_NO_CONTEXT) {
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            if (!is_software_renderer(renderer_name())) return true;
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display_, context_);
    }
    eglTerminate(display_);
    return false;
}

void OffscreenContext::start_surfaceless() {
    display_ = surfaceless_display();
    context_ = make_context(display_);
    if (context_ == EGL_NO_CONTEXT) {
        const std::string found = offered_opengl(display_);
        eglTerminate(display_);
        fail(found);
    }
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
        fail("EGL's context cannot be used without a surface");
    }
}

// EGL's display belongs to the process and stays: ending it would end every other context on it.
OffscreenContext::~OffscreenContext() {
    release();
    eglDestroyContext(display_, context_);
}

void OffscreenContext::make_current() const {
    eglBindAPI(EGL_OPENGL_API);
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

void OffscreenContext::release() const {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

std::unique_ptr<SecondContext> OffscreenContext::second() const {
    const EGLContext context = make_context(display_, context_);
    if (context == EGL_NO_CONTEXT) return nullptr;
    return std::make_unique<SecondEglContext>(display_, context);
}

std::string renderer_name() {
    const auto text = [](GLenum name) {
        const GLubyte* value = glGetString(name);
        return value ? std::string(reinterpret_cast<const char*>(value)) : std::string("unknown");
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

void require_opengl_3_3() {
    const int version = epoxy_gl_version();
    if (version >= 33) return;
    throw NoOpenGl(fmt::format("OpenGL 3.3 is needed, the driver offers {}.{}; {}", version / 10,
                               version % 10, what_to_install));
}

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
