// A window's mouse and keys as Dear ImGui takes them. The one place that knows how its versions differ: up
// to 1.86 (Debian 12) a program writes the state of keys into tables, from 1.87 on (Debian 13) it reports
// events, and the tables are refused.
#pragma once

#include <imgui.h>

#include <array>

#include "render_client/ui/input/clipboard.h"
#include "render_client/ui/input/window_input.h"

namespace osteomill {

/// Once for each context, before its first frame.
void prepare_panel_input(ImGuiIO& io);

/// Texts are cut, copied and pasted by way of `clipboard`, which must outlive the context. Without one Dear
/// ImGui keeps them to itself.
void give_clipboard(Clipboard& clipboard, ImGuiIO& io);

/// Mouse and keys, frame after frame. A press that is shorter than a frame lasts for one; presses that follow
/// one another within a frame, or frame upon frame, each come with a release before them, so that none is
/// lost.
class PanelInput {
  public:
    void feed(const WindowInput& input, ImGuiIO& io);

  private:
    struct Switch {
        bool is_down = false;
        int waiting = 0;
        /// Whether it is down in the next frame: `presses` came since the last one, `is_held` now.
        bool next(int presses, bool is_held);
    };

    std::array<Switch, WindowInput::most_keys> keys_{};
    std::array<Switch, WindowInput::buttons> buttons_{};
};

}  // namespace osteomill
