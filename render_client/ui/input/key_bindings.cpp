#include "render_client/ui/input/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace osteomill {

namespace {

bool holds(const KeyBinding& binding, Situation situation) {
    return binding.situation == Situation::always || binding.situation == situation;
}

const std::vector<KeyBinding>& table() {
    using enum Situation;
    static const std::vector<KeyBinding> bindings{
        {drilling, {}, Action::none, "left drag", "move the hand in the picture's plane"},
        {drilling, {GLFW_KEY_W, GLFW_KEY_S}, Action::none, "W, S, ctrl + wheel", "into the bone, out of it"},
        {drilling, {GLFW_KEY_SPACE}, Action::none, "SPACE (held)", "pedal: the spindle turns"},
        {drilling,
         {GLFW_KEY_1, GLFW_KEY_2, GLFW_KEY_3, GLFW_KEY_4, GLFW_KEY_5, GLFW_KEY_6, GLFW_KEY_7, GLFW_KEY_8,
          GLFW_KEY_9},
         Action::none,
         "1 to 9",
         "choose a burr"},
        {drilling, {GLFW_KEY_RIGHT_BRACKET}, Action::next_burr, "]", "the next burr"},
        {drilling, {GLFW_KEY_LEFT_BRACKET}, Action::previous_burr, "[", "the burr before"},
        {playing, {GLFW_KEY_SPACE}, Action::play_or_pause, "SPACE", "play, pause"},
        {playing, {GLFW_KEY_LEFT}, Action::back_5_s, "LEFT", "5 s back"},
        {playing, {GLFW_KEY_RIGHT}, Action::on_5_s, "RIGHT", "5 s on"},
        {playing, {}, Action::none, "left drag", "turn the view"},
        {looking_on, {}, Action::none, "left drag", "turn the view"},
        {always, {}, Action::none, "right drag", "turn the view"},
        {always, {}, Action::none, "middle drag", "shift the view; shift + right drag does, too"},
        {always, {}, Action::none, "wheel", "zoom"},
        {always, {}, Action::none, "click on the cube", "look at that side"},
        {always, {GLFW_KEY_HOME}, Action::first_view, "HOME", "the first view again"},
        {always, {GLFW_KEY_X}, Action::cut_x, "X", "cut left/right: on, other half, off"},
        {always, {GLFW_KEY_Y}, Action::cut_y, "Y", "cut front/back"},
        {always, {GLFW_KEY_Z}, Action::cut_z, "Z", "cut above/below"},
        {always, {GLFW_KEY_C}, Action::cut_view, "C", "cut across the view"},
        {always, {}, Action::none, "alt + wheel", "move the last of the cuts"},
        {always, {GLFW_KEY_F1}, Action::help, "F1", "this help"},
        {always, {GLFW_KEY_F2}, Action::theme, "F2", "light or dark"},
        {always, {GLFW_KEY_F3}, Action::panels, "F3", "panels on, off"},
        {always, {GLFW_KEY_F4}, Action::cuts_panel, "F4", "panel of the cuts"},
        {always, {GLFW_KEY_F5}, Action::transfer_panel, "F5", "panel of colours and opacity"},
        {always, {GLFW_KEY_F11}, Action::export_frames, "F11", "write every frame as PNG: begin, end"},
        {always, {GLFW_KEY_F12, GLFW_KEY_P}, Action::screenshot, "F12, P", "write this picture as PNG"},
        {always, {GLFW_KEY_ESCAPE}, Action::end, "ESC", "end"},
    };
    return bindings;
}

}  // namespace

Situation situation_of(bool drills, bool shows_recording) {
    if (drills) return Situation::drilling;
    return shows_recording ? Situation::playing : Situation::looking_on;
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
    for (const KeyBinding& binding : table())
        if (holds(binding, situation)) lines.push_back({binding.name, binding.meaning});
    switch (situation) {
        case Situation::drilling:
            lines.push_back({"orange arrow", "the force that an arm would give to the hand"});
            lines.push_back({"blue ball", "where the hand wants the burr"});
            break;
        case Situation::looking_on:
            lines.push_back({"", "This server has its own device: to drill with the mouse,"});
            lines.push_back({"", "start haptic_server with --device client."});
            break;
        default:
            break;
    }
    return lines;
}

}  // namespace osteomill
