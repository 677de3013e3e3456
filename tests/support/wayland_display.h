// A Wayland compositor (weston) whose one screen is a window that fills an X server without a monitor: there
// its screen can be read, and its mouse and keyboard are moved.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_display.h"

namespace osteomill::testing {

class WaylandDisplay {
  public:
    /// How windows are shown: each in a place of its own, or only the last one, which fills the screen.
    enum class Shell { desktop, kiosk };

    /// The parts that this machine lacks for it; empty if all are there.
    static std::string missing();

    /// A screen of `size_px`, with `scale` pixels in each unit of a window's size, on plain green. Throws
    /// std::runtime_error if it does not come up.
    WaylandDisplay(const glm::ivec2& size_px, int scale, Shell shell);

    /// `command` with its windows on this display, without frames, and no other display to be found.
    std::vector<std::string> shown_here(std::vector<std::string> command) const;
    /// Reads its screen, moves its mouse, presses its keys.
    const VirtualDisplay& outside() const { return outside_; }
    /// Ends the compositor under its clients.
    void break_down() { compositor_.reset(); }

  private:
    TemporaryFolder folder_;
    VirtualDisplay outside_;
    std::optional<ChildProcess> compositor_;
};

}  // namespace osteomill::testing
