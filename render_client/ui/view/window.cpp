#include "render_client/ui/view/window.h"

#include <epoxy/gl.h>
// GLFW comes after libepoxy, which brings OpenGL's declarations.
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <glm/common.hpp>
#include <stdexcept>
#include <string>

#include "render_client/ui/input/keyboard.h"
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

namespace {

/// A message on the version that this display offers if it is not OpenGL 3.3.
std::string offered_opengl() {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(16, 16, "", nullptr, nullptr);
    if (!window) return "the display offers no OpenGL at all (" + WindowSystem::last_error() + ")";
    glfwMakeContextCurrent(window);
    const std::string found = "the display offers " + gl::renderer_name();
    glfwDestroyWindow(window);
    return found;
}

class UnseenContext final : public gl::SecondContext {
  public:
    explicit UnseenContext(GLFWwindow* window) : window_(window) {}
    void make_current() override { glfwMakeContextCurrent(window_); }
    void release() override { glfwMakeContextCurrent(nullptr); }

  private:
    GLFWwindow* window_;
};

}  // namespace

Window::Window(const glm::ivec2& size_px, const std::string& title, bool quad_buffer) {
    system_.hint_identity();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    glfwWindowHint(GLFW_STEREO, quad_buffer ? GLFW_TRUE : GLFW_FALSE);
    window_ = glfwCreateWindow(size_px.x, size_px.y, title.c_str(), nullptr, nullptr);
    if (!window_) require_display();
    if (quad_buffer && !window_)
        throw std::runtime_error(
            "--stereo quad-buffer: this display or its driver has no buffers for two eyes; use side-by-side, "
            "top-bottom or rows");
    if (!window_)
        throw gl::NoOpenGl("OpenGL 3.3 is needed; " + offered_opengl() +
                           "; install a graphics driver, or Mesa's software one: apt-get install "
                           "libgl1-mesa-dri libgl1");
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    unseen_ = glfwCreateWindow(1, 1, "", nullptr, window_);
    watch_input();
}

void Window::watch_input() {
    glfwSetWindowUserPointer(window_, this);
    static constexpr auto input_of = [](GLFWwindow* window) -> WindowInput& {
        WindowInput& input = static_cast<Window*>(glfwGetWindowUserPointer(window))->input_;
        input.has_news = true;
        return input;
    };
    // Asking for a key's state now and then would miss a press in between.
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int held) {
        WindowInput& input = input_of(window);
        auto* const self = static_cast<Window*>(glfwGetWindowUserPointer(window));
        HeldKeys& keys = self->keys_;
        if (action == GLFW_PRESS) {
            const char* const printed = glfwGetKeyName(key, scancode);
            self->meant_keys_[scancode] = meant_key(key, printed != nullptr ? printed : "");
        }
        // The layout may change while a key is held.
        if (const auto meant = self->meant_keys_.find(scancode); meant != self->meant_keys_.end())
            key = meant->second;
        if (key < 0 || static_cast<std::size_t>(key) >= WindowInput::most_keys) return;
        const auto index = static_cast<std::size_t>(key);
        if (action == GLFW_RELEASE)
            keys.release(index, glfwGetTime());
        else if (keys.press(index, glfwGetTime()))
            input.presses.push_back({.key = key,
                                     .shift = (held & GLFW_MOD_SHIFT) != 0,
                                     .ctrl = (held & GLFW_MOD_CONTROL) != 0,
                                     .alt = (held & GLFW_MOD_ALT) != 0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int character) {
        WindowInput& input = input_of(window);
        const bool after_click = std::ranges::any_of(input.went_down, std::identity{});
        input.typed.emplace_back(character, input.presses.size(), after_click);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        WindowInput& input = input_of(window);
        if (button < 0 || static_cast<std::size_t>(button) >= WindowInput::buttons) return;
        // GLFW counts left, right, middle, as WindowInput does.
        const auto index = static_cast<std::size_t>(button);
        const bool goes_down = action == GLFW_PRESS;
        input.is_down[index] = goes_down;
        if (goes_down) input.went_down[index] = true;
        (goes_down ? input.pressed_at : input.released_at)[index] = input.cursor;
    });
    glfwSetScrollCallback(
        window_, [](GLFWwindow* window, double x, double y) { input_of(window).wheel += glm::dvec2(x, y); });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        input_of(window).cursor = {x, y};
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int) { input_of(window); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) { input_of(window); });
    glfwSetWindowIconifyCallback(window_, [](GLFWwindow* window, int) { input_of(window); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { input_of(window); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { input_of(window); });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* window, float, float) { input_of(window); });
    input_.has_news = true;
}

std::unique_ptr<gl::SecondContext> Window::second_context() const {
    if (unseen_ == nullptr) return nullptr;
    return std::make_unique<UnseenContext>(unseen_);
}

Window::~Window() {
    if (unseen_ != nullptr) glfwDestroyWindow(unseen_);
    glfwDestroyWindow(window_);
}

void Window::read_events(double at_most_s) {
    if (keys_.is_settling()) at_most_s = std::min(at_most_s, HeldKeys::longest_gap_s);
    if (at_most_s > 0.0)
        glfwWaitEventsTimeout(at_most_s);
    else
        glfwPollEvents();
}

WindowInput Window::take_input() {
    glm::ivec2 units(0), size_px(0);
    glfwGetWindowSize(window_, &units.x, &units.y);
    glfwGetFramebufferSize(window_, &size_px.x, &size_px.y);
    float scale_x = 1.0f, scale_y = 1.0f;
    glfwGetWindowContentScale(window_, &scale_x, &scale_y);
    input_.is_focused = glfwGetWindowAttrib(window_, GLFW_FOCUSED) != 0;
    input_.is_minimised = glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0 || size_px.x < 1 || size_px.y < 1;
    const bool is_over = glfwGetWindowAttrib(window_, GLFW_HOVERED) != 0;
    // GLFW asks the display, and without an answer returns garbage from the stack.
    require_display();
    input_.has_cursor = is_over || input_.is_focused;
    input_.size = glm::max(glm::dvec2(units), 1.0);
    input_.framebuffer_size_px = size_px;
    if (keys_.settle(glfwGetTime())) input_.has_news = true;
    input_.keys_down = keys_.down();
    input_.content_scale = std::clamp(static_cast<double>(std::max(scale_x, scale_y)), 1.0, 4.0);
    const auto is_either_down = [this](int left, int right) {
        return input_.keys_down[static_cast<std::size_t>(left)] ||
               input_.keys_down[static_cast<std::size_t>(right)];
    };
    input_.shift = is_either_down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    input_.ctrl = is_either_down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    input_.alt = is_either_down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
    WindowInput taken = input_;
    input_.forget_events();
    return taken;
}

void Window::hide() {
    if (!system_.has_gone()) glfwHideWindow(window_);
}

void Window::fill_screen(bool wanted) {
    if (wanted == (glfwGetWindowMonitor(window_) != nullptr)) return;
    if (!wanted) {
        glfwSetWindowMonitor(window_, nullptr, place_before_.x, place_before_.y, size_before_.x,
                             size_before_.y, GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &place_before_.x, &place_before_.y);
    glfwGetWindowSize(window_, &size_before_.x, &size_before_.y);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::serve(Clipboard& clipboard) {
    clipboard.serve([](const std::string& text) { glfwSetClipboardString(nullptr, text.c_str()); },
                    [] {
                        const char* const text = glfwGetClipboardString(nullptr);
                        return std::string(text != nullptr ? text : "");
                    });
}

void Window::wake() const {
    glfwPostEmptyEvent();
}

bool Window::take_close_request() {
    const bool is_asked = glfwWindowShouldClose(window_) != 0;
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return is_asked;
}

void Window::make_context_current() {
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(system_.swap_interval());
}

void Window::release_context() {
    glfwMakeContextCurrent(nullptr);
}

void Window::require_display() const {
    if (system_.has_gone())
        throw std::runtime_error("the display has gone: its server ended or closed the link");
}

void Window::require_drawable() const {
    require_display();
    if (epoxy_has_gl_extension("GL_ARB_robustness") && glGetGraphicsResetStatusARB() != GL_NO_ERROR)
        throw std::runtime_error("the graphics card was reset and the picture is lost; start again");
}

void Window::show_frame() {
    glfwSwapBuffers(window_);
}

}  // namespace osteomill
