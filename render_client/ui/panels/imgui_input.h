// A window's mouse and keys as Dear ImGui takes them. The one place that knows how its versions differ: up
// to 1.86 (Debian 12) a program writes the state of keys into tables, from 1.87 on (Debian 13) it reports
// events, and the tables are refused.
#pragma once

#include <imgui.h>

#include <array>
#include <bitset>
#include <deque>
#include <optional>

#include "render_client/ui/input/clipboard.h"
#include "render_client/ui/input/window_input.h"

namespace osteomill {

/// Once for each context, before its first frame.
void prepare_imgui_input(ImGuiIO& io);

/// Texts are cut, copied and pasted by way of `clipboard`, which must outlive the context. Without one Dear
/// ImGui keeps them to itself.
void give_clipboard(Clipboard& clipboard, ImGuiIO& io);

/// Mouse and keys, frame after frame. A press that is shorter than a frame lasts for one. Each frame presses
/// one key, in order, with the keys that were held at its time; a key that is pressed again is released
/// first. A button goes down and up where the pointer was at that time. A character comes after the clicks
/// and the keys that came before it. So nothing is lost or mistaken, however long a frame takes.
class ImguiInput {
  public:
    /// Whether presses or characters wait for the frames after the next one. `holds_text`: the field that
    /// characters are for is about to open, so they wait, and the keys behind them, too.
    bool feed(const WindowInput& input, ImGuiIO& io, bool holds_text = false);

  private:
    struct Button {
        bool is_down = false;
        int waiting = 0;
        std::optional<glm::dvec2> pressed_at{}, released_at{};  ///< of presses that no frame has seen
        bool next(bool is_pressed, bool is_held);
    };
    /// Passes a button on; the pointer is then where it went down or up, if it did.
    void feed_button(WindowInput::Button button, const WindowInput& input, ImGuiIO& io);
    /// The press that the next frame sees, if one is due; keys are up and down by it and by `input`.
    std::optional<KeyPress> next_press(const WindowInput& input, bool holds_text);

    /// The characters that are due in a frame of this key, and whose button goes down in it or not.
    void feed_text(bool is_command, bool clicks, ImGuiIO& io);

    std::deque<KeyPress> waiting_;
    std::deque<TypedCharacter> typed_;  ///< after_presses: of waiting_
    std::bitset<WindowInput::most_keys> keys_down_;
    std::array<Button, WindowInput::buttons> buttons_{};
};

}  // namespace osteomill
