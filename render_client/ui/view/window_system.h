// The system that shows GLFW's windows, X11 or Wayland. The one place that knows how they differ, and how
// GLFW does: up to 3.3 (Debian 12) it was built for one of them, from 3.4 on (Debian 13) it takes Wayland
// if there is one.
//
// Wayland tells no window where it is, nor that it is minimised or hidden, and moves none: GLFW refuses, with
// no harm. Sizes are in units of which a dense display has several pixels each.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace osteomill {

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

}  // namespace osteomill
