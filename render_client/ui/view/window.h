// A window with an OpenGL 3.3 core context (GLFW). One thread reads its events, the one that made it; the
// context may be another's, which draws.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <string>

#include "render_client/ui/input/clipboard.h"
#include "render_client/ui/input/held_keys.h"
#include "render_client/ui/input/window_input.h"
#include "render_client/ui/view/window_system.h"
#include "render_client/volume/gl/second_context.h"

struct GLFWwindow;

namespace osteomill {

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
