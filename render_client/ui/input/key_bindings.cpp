#include "render_client/ui/input/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "common/words/translation.h"

namespace osteomill {

namespace {

const char* heading_of(Topic topic) {
    switch (topic) {
        case Topic::hand:
            return "The hand";
        case Topic::session:
            return "The session";
        case Topic::recording:
            return "The recording";
        case Topic::view:
            return "The view";
        case Topic::cuts:
            return "Cuts";
        case Topic::panels:
            return "Panels and pictures";
    }
    return "";
}

const std::vector<KeyBinding>& table() {
    using enum Situation;
    using enum Topic;
    static const std::vector<KeyBinding> bindings{
        {hand, drilling, {}, Action::none, "left drag", "the burr goes over the bone under the pointer"},
        {hand, drilling, {}, Action::none, "with the pedal down", "it goes as the pointer moves"},
        {hand, drilling, {GLFW_KEY_W, GLFW_KEY_S}, Action::none, "W, S, wheel", "into the bone, out of it"},
        {hand, drilling, {GLFW_KEY_SPACE}, Action::none, "SPACE (held)", "pedal: the spindle turns"},
        {hand, drilling, {}, Action::none, "Pedal, on top", "holds it down until the next click"},
        {hand,
         drilling,
         {GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP, GLFW_KEY_DOWN},
         Action::none,
         "arrow keys",
         "tilt the handpiece"},
        {hand,
         drilling,
         {},
         Action::none,
         "shift + arrows",
         "move the burr sideways, up, down, as it is seen"},
        {hand, drilling, {GLFW_KEY_T}, Action::tilt, "T", "left drag tilts it: on, off"},
        {hand,
         drilling,
         {GLFW_KEY_1, GLFW_KEY_2, GLFW_KEY_3, GLFW_KEY_4, GLFW_KEY_5, GLFW_KEY_6, GLFW_KEY_7, GLFW_KEY_8,
          GLFW_KEY_9},
         Action::none,
         "1 to 9",
         "choose a burr"},
        {hand,
         drilling,
         {GLFW_KEY_RIGHT_BRACKET, GLFW_KEY_PAGE_DOWN},
         Action::next_burr,
         "] or PAGE DOWN",
         "the next burr"},
        {hand,
         drilling,
         {GLFW_KEY_LEFT_BRACKET, GLFW_KEY_PAGE_UP},
         Action::previous_burr,
         "[ or PAGE UP",
         "the burr before"},
        {hand,
         live,
         {GLFW_KEY_PERIOD, GLFW_KEY_INSERT},
         Action::faster,
         ". or INSERT",
         "the spindle turns faster by a tenth"},
        {hand, live, {GLFW_KEY_COMMA, GLFW_KEY_DELETE}, Action::slower, ", or DELETE", "slower"},
        {session,
         live,
         {GLFW_KEY_L},
         Action::place,
         "L, then click",
         "put the tool there (shift: upright on the bone)"},
        {session,
         live,
         {GLFW_KEY_B},
         Action::move_bone,
         "B, then drag, B",
         "turn the bone under the tool (shift: move it)"},
        {session, live, {GLFW_KEY_U}, Action::undo, "U", "undo the last stroke, of a long one 3 s"},
        {session, live, {GLFW_KEY_R}, Action::redo, "R", "redo it"},
        {session, live, {GLFW_KEY_H}, Action::hold, "H", "pause: force and spindle off; go on"},
        {session, live, {GLFW_KEY_M}, Action::mark, "M", "mark this moment, with a note"},
        {session, live, {GLFW_KEY_F6}, Action::save, "F6", "save the bone as it is"},
        {session, live, {GLFW_KEY_F8}, Action::save_surface, "F8", "save its surface as STL, PLY, OBJ"},
        {session, live, {GLFW_KEY_F10}, Action::finish, "F10", "finish the session"},
        {recording, playing, {GLFW_KEY_SPACE}, Action::play_or_pause, "SPACE", "play, pause"},
        {recording, playing, {GLFW_KEY_LEFT}, Action::back_5_s, "LEFT", "5 s back"},
        {recording, playing, {GLFW_KEY_RIGHT}, Action::on_5_s, "RIGHT", "5 s on"},
        {view, playing, {}, Action::none, "left drag", "turn the view"},
        {view, looking_on, {}, Action::none, "left drag", "turn the view"},
        {view, always, {}, Action::none, "right drag", "turn the view"},
        {view, always, {}, Action::none, "middle drag", "shift the view; shift + right drag does, too"},
        {view, drilling, {}, Action::none, "ctrl + wheel", "zoom"},
        {view, playing, {}, Action::none, "wheel", "zoom"},
        {view, looking_on, {}, Action::none, "wheel", "zoom"},
        {view, always, {}, Action::none, "click on the cube", "look at that side"},
        {view, always, {GLFW_KEY_HOME}, Action::first_view, "HOME", "the first view again"},
        {view,
         always,
         {GLFW_KEY_A, GLFW_KEY_D, GLFW_KEY_E, GLFW_KEY_Q},
         Action::none,
         "A, D, E, Q (held)",
         "the view to the left, right, up, down"},
        {view, always, {GLFW_KEY_EQUAL, GLFW_KEY_KP_ADD}, Action::magnify, "+", "magnify by a step"},
        {view, always, {GLFW_KEY_MINUS, GLFW_KEY_KP_SUBTRACT}, Action::widen, "-", "see more by a step"},
        {view, always, {GLFW_KEY_V}, Action::light_field, "V", "a microscope's round field: on, off"},
        {view, always, {GLFW_KEY_I}, Action::inset, "I", "second view: endoscope, axial, off"},
        {cuts, always, {GLFW_KEY_X}, Action::cut_x, "X", "cut left/right: on, other half, off"},
        {cuts, always, {GLFW_KEY_Y}, Action::cut_y, "Y", "cut front/back"},
        {cuts, always, {GLFW_KEY_Z}, Action::cut_z, "Z", "cut above/below"},
        {cuts, always, {GLFW_KEY_C}, Action::cut_view, "C", "cut across the view"},
        {cuts, always, {}, Action::none, "alt + wheel", "move the last of the cuts"},
        {panels, always, {GLFW_KEY_F1}, Action::help, "F1", "this help"},
        {panels, always, {GLFW_KEY_F2}, Action::theme, "F2", "light or dark"},
        {panels, always, {GLFW_KEY_F3}, Action::panels, "F3", "panels on, off"},
        {panels, always, {GLFW_KEY_F4}, Action::cuts_panel, "F4", "panel of the cuts"},
        {panels, always, {GLFW_KEY_F5}, Action::transfer_panel, "F5", "panel of colours and opacity"},
        {panels, always, {GLFW_KEY_F7}, Action::slices, "F7", "slices of the CT"},
        {panels, always, {GLFW_KEY_F9}, Action::sound, "F9", "sound of the burr: on, off"},
        {panels, always, {GLFW_KEY_N}, Action::warnings, "N", "the tone of the warnings: on, off"},
        {panels, always, {GLFW_KEY_F11}, Action::fullscreen, "F11", "the whole screen: on, off"},
        {panels, always, {GLFW_KEY_F12}, Action::details, "F12", "figures of picture, link and solver"},
        {panels, always, {GLFW_KEY_P}, Action::screenshot, "P", "write this picture as PNG"},
        {panels, always, {GLFW_KEY_O}, Action::export_frames, "O", "write every frame as PNG: begin, end"},
        {panels, always, {GLFW_KEY_ESCAPE}, Action::end, "ESC", "back; then end, asking first"},
    };
    return bindings;
}

/// The actions that have an effect there: no session can be seen yet.
bool acts_on_start_page(Action action) {
    using enum Action;
    constexpr std::array acting{help, theme, sound, warnings, fullscreen, screenshot, end};
    return std::ranges::find(acting, action) != acting.end();
}

}  // namespace

bool holds(const KeyBinding& binding, Situation situation) {
    if (situation == Situation::starting) return acts_on_start_page(binding.action);
    return binding.situation == Situation::always || binding.situation == situation ||
           (binding.situation == Situation::live &&
            (situation == Situation::drilling || situation == Situation::looking_on));
}

Situation situation_of(bool drills, bool shows_recording) {
    if (drills) return Situation::drilling;
    return shows_recording ? Situation::playing : Situation::looking_on;
}

glm::ivec2 HeldViewMotion::motion(const std::bitset<WindowInput::most_keys>& keys_down, double now_s) {
    static constexpr std::array<int, 4> keys{GLFW_KEY_D, GLFW_KEY_A, GLFW_KEY_Q, GLFW_KEY_E};
    std::array<int, keys.size()> held{};
    for (std::size_t i = 0; i < keys.size(); ++i) {
        std::optional<double>& since_s = down_since_s_[i];
        if (!keys_down[static_cast<std::size_t>(keys[i])])
            since_s.reset();
        else if (!since_s)
            since_s = now_s;
        held[i] = since_s && now_s - *since_s >= shortest_hold_s ? 1 : 0;
    }
    return {held[0] - held[1], held[2] - held[3]};
}

std::string key_of(Action action) {
    const auto binding = std::ranges::find(table(), action, &KeyBinding::action);
    if (action == Action::none || binding == table().end()) return "";
    const int key = binding->keys.front();
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
    // GLFW numbers letters and signs as ASCII does; the others are called as in the help.
    return key > GLFW_KEY_SPACE && key < GLFW_KEY_ESCAPE ? std::string(1, static_cast<char>(key))
                                                         : binding->name;
}

std::span<const KeyBinding> key_bindings() {
    return table();
}

std::vector<Action> actions_of(std::span<const int> pressed_keys, Situation situation) {
    std::vector<Action> actions;
    for (const int key : pressed_keys)
        for (const KeyBinding& binding : table())
            if (holds(binding, situation) && binding.action != Action::none &&
                std::find(binding.keys.begin(), binding.keys.end(), key) != binding.keys.end())
                actions.push_back(binding.action);
    return actions;
}

std::vector<HelpLine> help_lines(Situation situation) {
    std::vector<HelpLine> lines;
    if (situation == Situation::starting)
        lines = {{"", "This page", true},
                 {"a card", "a case, built in or imported by you: choose one; twice: start it"},
                 {"TAB, arrows, RETURN", "the same by keyboard"},
                 {"trainee", "whose session it will be: named in its folder and its report"},
                 {"Start", "the session begins on this machine, and this window joins it"},
                 {"Import a scan ...", "make a case of a CT: choose its files, a region, a threshold"},
                 {"Import labels ...", "make a case of a segmentation, without a CT"},
                 {"Open a recording ...", "see a session again, in a window of its own"},
                 {"Compare all sessions", "learning curves of the sessions that were kept here"},
                 {"Tour", "what the window is for, on the three cards that a new user sees"},
                 {"Hide this", "look at the bone of the last session; ESC: back"},
                 {"", "Mouse and keys of a session: F1, once it runs."}};
    std::optional<Topic> topic;
    for (const KeyBinding& binding : table()) {
        if (!holds(binding, situation)) continue;
        if (topic != binding.topic) lines.push_back({"", heading_of(binding.topic), true});
        topic = binding.topic;
        lines.push_back({binding.name, binding.meaning});
    }
    switch (situation) {
        case Situation::drilling:
            lines.push_back({"", "In the picture", true});
            lines.push_back({"orange arrow", "the force that an arm would give to the hand"});
            lines.push_back({"blue ball", "where the hand wants the burr"});
            lines.push_back({"ring on the bone", "where the burr would meet it along its spindle"});
            break;
        case Situation::looking_on:
            lines.push_back({"", "This server has its own device: to drill with the mouse,"});
            lines.push_back({"", "end this window and start a case from the page of cases."});
            break;
        default:
            break;
    }
    for (HelpLine& line : lines) line = {tr(line.name), tr(line.meaning), line.is_heading};
    return lines;
}

}  // namespace osteomill
