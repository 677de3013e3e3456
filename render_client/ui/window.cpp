#include "render_client/ui/window.h"

#include <epoxy/gl.h>
// GLFW comes after libepoxy, which brings OpenGL's declarations.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "render_client/ui/display_watch.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

std::string last_glfw_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "unknown reason";
}

/// What this display offers where it is not OpenGL 3.3, in words.
std::string offered_opengl() {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(16, 16, "", nullptr, nullptr);
    if (!window) return "the display offers no OpenGL at all (" + last_glfw_error() + ")";
    glfwMakeContextCurrent(window);
    const std::string found = "the display offers " + gl::renderer_name();
    glfwDestroyWindow(window);
    return found;
}

}  // namespace

Window::Window(const glm::ivec2& size_px, const std::string& title) {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
        throw gl::NoOpenGl("no display (neither DISPLAY nor WAYLAND_DISPLAY is set); use --offscreen");
    if (!glfwInit()) throw gl::NoOpenGl("no window: " + last_glfw_error() + "; use --offscreen");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    window_ = glfwCreateWindow(size_px.x, size_px.y, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string found = offered_opengl();
        glfwTerminate();
        throw gl::NoOpenGl("OpenGL 3.3 is needed; " + found +
                           "; install a graphics driver, or Mesa's software one: apt-get install "
                           "libgl1-mesa-dri libgl1");
    }
    watch_display(&is_display_gone_);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    // Asking for a key's state once a frame would miss a press shorter than a frame.
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
        if (action == GLFW_PRESS)
            static_cast<Window*>(glfwGetWindowUserPointer(window))->presses_.push_back(key);
    });
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool Window::close_asked() const {
    return glfwWindowShouldClose(window_) != 0;
}
bool Window::focused() const {
    return glfwGetWindowAttrib(window_, GLFW_FOCUSED) != 0;
}
bool Window::minimised() const {
    const glm::ivec2 size_px = framebuffer_size_px();
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0 || size_px.x < 1 || size_px.y < 1;
}
bool Window::key_down(int glfw_key) const {
    return glfwGetKey(window_, glfw_key) == GLFW_PRESS;
}

glm::ivec2 Window::framebuffer_size_px() const {
    glm::ivec2 size_px(0);
    glfwGetFramebufferSize(window_, &size_px.x, &size_px.y);
    // GLFW asks the display, and without an answer gives what lies on the stack.
    require_display();
    return size_px;
}

double Window::content_scale() const {
    float scale_x = 1.0f, scale_y = 1.0f;
    glfwGetWindowContentScale(window_, &scale_x, &scale_y);
    return std::clamp(static_cast<double>(std::max(scale_x, scale_y)), 0.5, 4.0);
}

void Window::require_display() const {
    if (is_display_gone_)
        throw std::runtime_error("the display has gone: its server ended or closed the link");
}

void Window::require_alive() const {
    require_display();
    if (epoxy_has_gl_extension("GL_ARB_robustness") && glGetGraphicsResetStatusARB() != GL_NO_ERROR)
        throw std::runtime_error("the graphics card was reset and the picture is lost; start again");
}

void Window::show_frame() {
    glfwSwapBuffers(window_);
}

}  // namespace osteomill
