// A window with an OpenGL 3.3 core context (GLFW), current on the calling thread.
#pragma once

#include <glm/vec2.hpp>
#include <span>
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
    /// Throws as require_alive() where the display has gone.
    bool minimised() const;
    bool key_down(int glfw_key) const;
    /// The keys that went down since the last clear_presses(), even if they are up again by now.
    std::span<const int> presses() const { return presses_; }
    void clear_presses() { presses_.clear(); }
    /// Of the picture, which on dense displays has more pixels than the window has units. Throws as
    /// require_alive() where the display has gone.
    glm::ivec2 framebuffer_size_px() const;
    /// How many times as dense as an ordinary one the display is, in pixels of the picture.
    double content_scale() const;
    /// Throws std::runtime_error where the display has gone (its server ended or shut this program out) or
    /// the graphics card was reset: nothing more can be shown.
    void require_alive() const;
    void show_frame();
    GLFWwindow* handle() const { return window_; }

  private:
    void require_display() const;

    GLFWwindow* window_ = nullptr;
    std::vector<int> presses_;
    bool is_display_gone_ = false;
};

}  // namespace osteomill
