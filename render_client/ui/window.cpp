#include "render_client/ui/window.h"

#include <epoxy/gl.h>
// GLFW comes after libepoxy, which brings OpenGL's declarations.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdlib>

#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

std::string last_glfw_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "unknown reason";
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
    window_ = glfwCreateWindow(size_px.x, size_px.y, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw gl::NoOpenGl("no OpenGL 3.3 window: " + reason +
                           "; install a graphics driver, or Mesa's software one: apt-get install "
                           "libgl1-mesa-dri libgl1");
    }
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

bool Window::was_pressed(int glfw_key) const {
    return std::find(presses_.begin(), presses_.end(), glfw_key) != presses_.end();
}

glm::ivec2 Window::framebuffer_size_px() const {
    glm::ivec2 size_px(0);
    glfwGetFramebufferSize(window_, &size_px.x, &size_px.y);
    return size_px;
}

void Window::show_frame() {
    glfwSwapBuffers(window_);
}

}  // namespace osteomill
