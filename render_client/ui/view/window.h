// A window with an OpenGL 3.3 core context (GLFW). One thread reads its events, the one that made it; the
// context may be another's, which draws.
#pragma once

#include <atomic>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <string>

#include "render_client/ui/input/clipboard.h"
#include "render_client/ui/input/keyboard.h"
#include "render_client/ui/input/window_input.h"
#include "render_client/volume/gl/storage_thread.h"

struct GLFWwindow;

namespace osteomill {

// The system that shows GLFW's windows, X11 or Wayland. The one place that knows how they differ, and how
// GLFW does: up to 3.3 (Debian 12) it was built for one of them, from 3.4 on (Debian 13) it takes Wayland
// if there is one.
//
// Wayland tells no window where it is, nor that it is minimised or hidden, and moves none: GLFW refuses, with
// no harm. Sizes are in units of which a dense display has several pixels each.

/// Alive from before the first window until after the last.
class WindowSystem {
  public:
    /// Throws gl::NoOpenGl if no display can be reached.
    WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
    WindowSystem& operator=(const WindowSystem&) = delete;
    ~WindowSystem();

    /// So the desktop finds the name and the picture of the next window, in
    /// scripts/desktop/osteomill.desktop.
    void hint_identity() const;

    /// Refreshes of the display that a picture waits for before it is shown, see glfwSwapInterval. None under
    /// Wayland: it has no refreshes for a window that is hidden, whose thread would wait for ever.
    int swap_interval() const { return error_of_wayland_ ? 0 : 1; }

    /// The display's server ended or shut this program out; drawing is then lost without harm. On any thread.
    bool has_gone() const;

    /// Why GLFW's last call on this thread failed.
    static std::string last_error();

  private:
    void watch_x11();
    void watch_wayland();

    std::atomic<bool> x11_has_gone_{false};
    std::function<int()> error_of_wayland_;  ///< empty where GLFW uses X11
};

class Window {
  public:
    /// Throws gl::NoOpenGl if there is no display or no OpenGL 3.3; the message has the remedy. The context
    /// is current on no thread. `quad_buffer`: with a back buffer for each eye; std::runtime_error if the
    /// driver has none.
    Window(const glm::ivec2& size_px, const std::string& title, bool quad_buffer = false);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    // Thread of the window.

    /// Reads events, after waiting up to `at_most_s` for one.
    void read_events(double at_most_s);
    /// The window as it is, and all that happened since the last call. Throws std::runtime_error if the
    /// display has gone (its server ended or shut this program out): nothing more can be shown.
    WindowInput take_input();
    /// The whole screen, or the place and size that it had before.
    void fill_screen(bool wanted);
    /// Serves the panels' requests of the desktop's clipboard.
    void serve(Clipboard& clipboard);
    /// Whether the user has tried to close it since the last call.
    bool take_close_request();
    /// Nothing more is drawn in it, though the program goes on.
    void hide();

    // Any thread.

    /// Ends the wait for events.
    void wake() const;

    // Thread that draws.

    /// One that shares the window's textures and must not outlive it; null if the driver makes none.
    std::unique_ptr<gl::SecondContext> second_context() const;
    void make_context_current();
    void release_context();
    /// Throws std::runtime_error if the display has gone or the graphics card was reset.
    void require_drawable() const;
    void show_frame();

  private:
    void require_display() const;
    void watch_input();

    WindowSystem system_;
    GLFWwindow* window_ = nullptr;
    GLFWwindow* unseen_ = nullptr;  ///< has the second context
    WindowInput input_;
    glm::ivec2 place_before_{0}, size_before_{0};  ///< it filled the screen
    HeldKeys keys_;
    std::map<int, int> meant_keys_;  ///< by scancode, as each was pressed last
};

}  // namespace osteomill
