#include "render_client/ui/panels/imgui_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <iterator>
#include <limits>
#include <utility>

namespace osteomill {

namespace {

/// Keys that texts are edited with and pages are gone through, of GLFW and of Dear ImGui.
constexpr std::array panel_keys{
    std::pair{GLFW_KEY_BACKSPACE, ImGuiKey_Backspace}, std::pair{GLFW_KEY_DELETE, ImGuiKey_Delete},
    std::pair{GLFW_KEY_LEFT, ImGuiKey_LeftArrow}, std::pair{GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
    std::pair{GLFW_KEY_HOME, ImGuiKey_Home}, std::pair{GLFW_KEY_END, ImGuiKey_End},
    std::pair{GLFW_KEY_ENTER, ImGuiKey_Enter}, std::pair{GLFW_KEY_UP, ImGuiKey_UpArrow},
    std::pair{GLFW_KEY_DOWN, ImGuiKey_DownArrow}, std::pair{GLFW_KEY_TAB, ImGuiKey_Tab},
    std::pair{GLFW_KEY_SPACE, ImGuiKey_Space},
    // With Ctrl: all, copy, paste, cut, redo, undo.
    std::pair{GLFW_KEY_A, ImGuiKey_A}, std::pair{GLFW_KEY_C, ImGuiKey_C}, std::pair{GLFW_KEY_V, ImGuiKey_V},
    std::pair{GLFW_KEY_X, ImGuiKey_X}, std::pair{GLFW_KEY_Y, ImGuiKey_Y}, std::pair{GLFW_KEY_Z, ImGuiKey_Z}};

/// A press that Dear ImGui would not see, such as that of a letter without ctrl, takes no frame.
bool is_seen(const KeyPress& press) {
    if (press.key >= GLFW_KEY_A && press.key <= GLFW_KEY_Z && !press.ctrl) return false;
    return std::ranges::any_of(panel_keys, [&](const auto& key) { return key.first == press.key; });
}

#if IMGUI_VERSION_NUM >= 18700

void feed_modifiers(bool shift, bool ctrl, bool alt, ImGuiIO& io) {
    io.AddKeyEvent(ImGuiMod_Shift, shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, ctrl);
    io.AddKeyEvent(ImGuiMod_Alt, alt);
}

void feed_key(ImGuiKey key, bool is_down, ImGuiIO& io) {
    io.AddKeyEvent(key, is_down);
}

#else

void feed_modifiers(bool shift, bool ctrl, bool alt, ImGuiIO& io) {
    io.KeyShift = shift;
    io.KeyCtrl = ctrl;
    io.KeyAlt = alt;
}

void feed_key(ImGuiKey_ key, bool is_down, ImGuiIO& io) {
    io.KeysDown[key] = is_down;
    // It presses the focused item by SPACE alone.
    if (key == ImGuiKey_Enter && is_down && !io.WantTextInput) io.NavInputs[ImGuiNavInput_Activate] = 1.0f;
}

#endif

}  // namespace

void prepare_imgui_input(ImGuiIO& io) {
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
#if IMGUI_VERSION_NUM >= 18700
    // A frame gets all that happened since the last one, as the rest of the window does.
    io.ConfigInputTrickleEventQueue = false;
#else
    for (const auto& [key, in_imgui] : panel_keys) io.KeyMap[in_imgui] = in_imgui;
#endif
}

void give_clipboard(Clipboard& clipboard, ImGuiIO& io) {
    io.ClipboardUserData = &clipboard;
    io.SetClipboardTextFn = [](void* to, const char* text) { static_cast<Clipboard*>(to)->copy(text); };
    io.GetClipboardTextFn = [](void* from) { return static_cast<Clipboard*>(from)->paste().c_str(); };
}

bool ImguiInput::Button::next(bool is_pressed, bool is_held) {
    waiting += is_pressed ? 1 : 0;
    const bool was_down = std::exchange(is_down, waiting > 0 || is_held);
    if (waiting == 0) return is_down;
    if (was_down)
        is_down = false;  // the release before the next press
    else
        --waiting;
    return is_down;
}

std::optional<KeyPress> ImguiInput::next_press(const WindowInput& input, bool holds_text) {
    for (TypedCharacter character : input.typed) {
        const auto end = input.presses.begin() + static_cast<std::ptrdiff_t>(character.after_presses);
        const auto before = std::count_if(input.presses.begin(), end, is_seen);
        character.after_presses = waiting_.size() + static_cast<std::size_t>(before);
        typed_.push_back(character);
    }
    std::ranges::copy_if(input.presses, std::back_inserter(waiting_), is_seen);
    const bool has_text = !typed_.empty() && typed_.front().after_presses == 0;
    std::optional<KeyPress> press;
    std::bitset<WindowInput::most_keys> down = keys_down_ & input.keys_down;
    // A command acts on the text that is there: not in the frame that brings some of it.
    if (!waiting_.empty() && !(has_text && (holds_text || waiting_.front().ctrl))) {
        const auto key = static_cast<std::size_t>(waiting_.front().key);
        if (keys_down_[key]) {
            down.reset(key);  // the release before the next press
        } else {
            press = waiting_.front();
            waiting_.pop_front();
            down.set(key);
        }
    }
    keys_down_ = down;
    return press;
}

void ImguiInput::feed_button(WindowInput::Button button, const WindowInput& input, ImGuiIO& io) {
    Button& passed_on = buttons_[button];
    if (input.pressed_at[button]) passed_on.pressed_at = input.pressed_at[button];
    if (input.released_at[button]) passed_on.released_at = input.released_at[button];
    const bool was_down = passed_on.is_down;
    const bool is_down = io.MouseDown[button] =
        passed_on.next(input.went_down[button], input.is_down[button]);
    if (is_down == was_down) return;
    const auto where = std::exchange(is_down ? passed_on.pressed_at : passed_on.released_at, std::nullopt);
    if (!where) return;
    const glm::vec2 at(*where * input.px_per_unit());
    io.MousePos = {at.x, at.y};
}

void ImguiInput::feed_text(bool is_command, bool clicks, ImGuiIO& io) {
    // Dear ImGui takes no text while ctrl is held.
    while (!is_command && !typed_.empty() && typed_.front().after_presses == 0 &&
           !(clicks && typed_.front().after_click)) {
        io.AddInputCharacter(typed_.front().character);
        typed_.pop_front();
    }
}

bool ImguiInput::feed(const WindowInput& input, ImGuiIO& io, bool holds_text) {
    constexpr float nowhere = -std::numeric_limits<float>::max();
    const glm::vec2 at(input.cursor * input.px_per_unit());
    io.MousePos = input.has_cursor ? ImVec2(at.x, at.y) : ImVec2(nowhere, nowhere);
    // Dear ImGui counts left, right, middle, as WindowInput does.
    bool clicks = false;
    for (const auto button : {WindowInput::left, WindowInput::right, WindowInput::middle}) {
        const bool was_down = buttons_[button].is_down;
        feed_button(button, input, io);
        clicks = clicks || (buttons_[button].is_down && !was_down) || buttons_[button].waiting > 0;
    }
    io.MouseWheel += static_cast<float>(input.wheel.y);
    io.MouseWheelH += static_cast<float>(input.wheel.x);
    const std::optional<KeyPress> press = next_press(input, holds_text);
    const KeyPress held =
        press.value_or(KeyPress{.shift = input.shift, .ctrl = input.ctrl, .alt = input.alt});
    if (!holds_text) feed_text(held.ctrl && !held.alt, clicks, io);
    if (press)
        for (TypedCharacter& character : typed_)
            if (character.after_presses > 0) --character.after_presses;
    feed_modifiers(held.shift, held.ctrl, held.alt, io);
    for (const auto& [key, in_imgui] : panel_keys)
        feed_key(in_imgui, keys_down_[static_cast<std::size_t>(key)], io);
    return !waiting_.empty() || !typed_.empty() ||
           std::any_of(buttons_.begin(), buttons_.end(), [](const Button& b) { return b.waiting > 0; });
}

}  // namespace osteomill
