#include "render_client/ui/view/window_system.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "render_client/volume/gl/offscreen_context.h"

struct wl_display;

namespace osteomill {

namespace {

/// The name of the desktop file.
constexpr const char* application = "osteomill";

std::string setting_of(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? fmt::format("{} is {}", variable, value) : fmt::format("{} is not set", variable);
}

/// GLFW's own connection to the display. Not every GLFW has both functions: calling one by name would not
/// link.
template <typename Connection>
Connection* connection_by(const char* function) {
    const auto connection = reinterpret_cast<Connection* (*)()>(::dlsym(RTLD_DEFAULT, function));
    return connection ? connection() : nullptr;
}

}  // namespace

WindowSystem::WindowSystem() {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
        throw gl::NoOpenGl("no display (neither DISPLAY nor WAYLAND_DISPLAY is set); use --offscreen");
#ifdef GLFW_PLATFORM
    // It would take any Wayland that this user has, such as the screen of a machine that was reached by ssh
    // -X.
    if (!std::getenv("WAYLAND_DISPLAY")) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (!glfwInit())
        throw gl::NoOpenGl(fmt::format("no window: {} ({}, {}); use --offscreen", last_error(),
                                       setting_of("WAYLAND_DISPLAY"), setting_of("DISPLAY")));
    watch_wayland();
    if (!error_of_wayland_) watch_x11();
}

WindowSystem::~WindowSystem() {
    // Under Wayland GLFW waits here for the display's pending messages: if the display has gone, for ever.
    if (!has_gone()) glfwTerminate();
}

std::string WindowSystem::last_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "unknown reason";
}

void WindowSystem::hint_identity() const {
    glfwWindowHintString(GLFW_X11_CLASS_NAME, application);
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, application);
#ifdef GLFW_WAYLAND_APP_ID
    glfwWindowHintString(GLFW_WAYLAND_APP_ID, application);
#endif
}

void WindowSystem::watch_x11() {
    Display* const display = connection_by<Display>("glfwGetX11Display");
    if (!display) return;
    // Xlib's own answer is to end the program on the spot, without a report.
    XSetIOErrorExitHandler(
        display,
        [](Display* lost, void* gone) {
            *static_cast<std::atomic<bool>*>(gone) = true;
            // Xlib has locked it for good, for a program that ends here: another thread that speaks to the
            // display would wait for ever.
            XUnlockDisplay(lost);
        },
        &x11_has_gone_);
    XSetIOErrorHandler([](Display*) { return 0; });
}

void WindowSystem::watch_wayland() {
    wl_display* const display = connection_by<wl_display>("glfwGetWaylandDisplay");
    if (!display) return;
    // GLFW has loaded the library, for itself alone.
    void* const library = ::dlopen("libwayland-client.so.0", RTLD_LAZY | RTLD_NOLOAD);
    const auto error_of =
        library ? reinterpret_cast<int (*)(wl_display*)>(::dlsym(library, "wl_display_get_error")) : nullptr;
    error_of_wayland_ = [error_of, display] { return error_of ? error_of(display) : 0; };
}

bool WindowSystem::has_gone() const {
    return x11_has_gone_ || (error_of_wayland_ && error_of_wayland_() != 0);
}

}  // namespace osteomill
