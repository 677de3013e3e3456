#include "render_client/ui/panels/panel_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
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

#if IMGUI_VERSION_NUM >= 18700

void feed_modifiers(const WindowInput& input, ImGuiIO& io) {
    io.AddKeyEvent(ImGuiMod_Shift, input.shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, input.ctrl);
    io.AddKeyEvent(ImGuiMod_Alt, input.alt);
}

void feed_key(ImGuiKey key, bool is_down, ImGuiIO& io) {
    io.AddKeyEvent(key, is_down);
}

#else

void feed_modifiers(const WindowInput& input, ImGuiIO& io) {
    io.KeyShift = input.shift;
    io.KeyCtrl = input.ctrl;
    io.KeyAlt = input.alt;
}

void feed_key(ImGuiKey_ key, bool is_down, ImGuiIO& io) {
    io.KeysDown[key] = is_down;
    // It presses what has the focus by SPACE alone.
    if (key == ImGuiKey_Enter && is_down && !io.WantTextInput) io.NavInputs[ImGuiNavInput_Activate] = 1.0f;
}

#endif

}  // namespace

void prepare_panel_input(ImGuiIO& io) {
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

bool PanelInput::Switch::next(int presses, bool is_held) {
    waiting += presses;
    const bool was_down = std::exchange(is_down, waiting > 0 || is_held);
    if (waiting == 0) return is_down;
    if (was_down)
        is_down = false;  // the release before the next press
    else
        --waiting;
    return is_down;
}

void PanelInput::feed(const WindowInput& input, ImGuiIO& io) {
    constexpr float nowhere = -std::numeric_limits<float>::max();
    const glm::vec2 at(input.cursor * input.px_per_unit());
    io.MousePos = input.has_cursor ? ImVec2(at.x, at.y) : ImVec2(nowhere, nowhere);
    const auto is_held = [&](WindowInput::Button button) {
        return buttons_[button].next(input.went_down[button] ? 1 : 0, input.is_down[button]);
    };
    io.MouseDown[ImGuiMouseButton_Left] = is_held(WindowInput::left);
    io.MouseDown[ImGuiMouseButton_Right] = is_held(WindowInput::right);
    io.MouseDown[ImGuiMouseButton_Middle] = is_held(WindowInput::middle);
    io.MouseWheel += static_cast<float>(input.wheel.y);
    io.MouseWheelH += static_cast<float>(input.wheel.x);
    for (const char32_t character : input.typed) io.AddInputCharacter(character);
    feed_modifiers(input, io);
    for (const auto& [key, in_imgui] : panel_keys) {
        const auto presses = std::count(input.presses.begin(), input.presses.end(), key);
        const auto number = static_cast<std::size_t>(key);
        feed_key(in_imgui, keys_[number].next(static_cast<int>(presses), input.keys_down[number]), io);
    }
}

}  // namespace osteomill
