// Bindings of keys and mouse: one table, from which the window acts, F1's help is printed and the tool bar
// names the keys of its buttons.
#pragma once

#include <array>
#include <bitset>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render_client/ui/input/window_input.h"

namespace osteomill {

/// Action of a single key press. Keys that act while held are in the table, too, so that the help shows them
/// and none is bound twice; their action is `none`.
enum class Action {
    none,
    help,
    theme,
    panels,
    cuts_panel,
    transfer_panel,
    slices,
    cut_x,
    cut_y,
    cut_z,
    cut_view,
    first_view,
    magnify,
    widen,
    light_field,
    inset,
    sound,
    warnings,
    screenshot,
    export_frames,
    details,
    fullscreen,
    end,
    next_burr,
    previous_burr,
    faster,
    slower,
    tilt,
    place,
    move_bone,
    save_surface,
    undo,
    redo,
    hold,
    mark,
    save,
    finish,
    play_or_pause,
    back_5_s,
    on_5_s,
};

/// The kind of session in which a binding is valid.
enum class Situation {
    always,
    drilling,    ///< the mouse moves the hand
    playing,     ///< a recording is shown
    looking_on,  ///< neither
    starting,    ///< the start page is shown
    live,        ///< drilling or looking on: there is a session that may be controlled
    waiting,     ///< for a session or its bone: nothing acts on it
};

Situation situation_of(bool drills, bool shows_recording);

/// The topic of a binding, for the help.
enum class Topic { hand, session, recording, view, cuts, panels };

struct KeyBinding {
    Topic topic = Topic::view;
    Situation situation = Situation::always;
    std::vector<int> keys;  ///< GLFW's numbers; empty for the mouse
    Action action = Action::none;
    const char* name = "";  ///< the key's or mouse button's name, for people
    const char* meaning = "";
};

/// Motion of the view by held keys. A key that is let go sooner was typed, by somebody who took the picture
/// for a field, and moves nothing.
class HeldViewMotion {
  public:
    static constexpr double shortest_hold_s = 0.2;

    /// In steps of one: x to the right, y down. `now_s`: any clock that never decreases.
    glm::ivec2 motion(const std::bitset<WindowInput::most_keys>& keys_down, double now_s);

  private:
    std::array<std::optional<double>, 4> down_since_s_{};
};

std::span<const KeyBinding> key_bindings();

/// The actions of the keys that went down, in their order.
std::vector<Action> actions_of(std::span<const int> pressed_keys, Situation situation);

/// The key of an action, for people: "U" or "F10"; empty if it has none.
std::string key_of(Action action);

/// Whether a binding is valid in that situation.
bool holds(const KeyBinding& binding, Situation situation);

/// A line of the help: a key and its effect. A line without a name goes on with the one before.
struct HelpLine {
    std::string name;
    std::string meaning;
    bool is_heading = false;  ///< heads the lines that follow; its text is `meaning`
};
std::vector<HelpLine> help_lines(Situation situation);

}  // namespace osteomill
