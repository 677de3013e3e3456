// A window with an OpenGL 3.3 core context (GLFW), current on the calling thread.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

struct GLFWwindow;

namespace osteomill {

class Window {
  public:
    /// Throws gl::NoOpenGl where there is no display or no OpenGL 3.3; the message says what to do.
    Window(const glm::ivec2& size_px, const std::string& title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    bool close_asked() const;
    bool focused() const;
    bool minimised() const;
    bool key_down(int glfw_key) const;
    /// Whether a key went down since the last clear_presses(), even if it is up again by now.
    bool was_pressed(int glfw_key) const;
    void clear_presses() { presses_.clear(); }
    /// Of the picture, which on dense displays has more pixels than the window has units.
    glm::ivec2 framebuffer_size_px() const;
    void show_frame();
    GLFWwindow* handle() const { return window_; }

  private:
    GLFWwindow* window_ = nullptr;
    std::vector<int> presses_;
};

}  // namespace osteomill
