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

bool is_down(const WindowInput& input, int key) {
    return input.keys_down[static_cast<std::size_t>(key)] ||
           std::find(input.presses.begin(), input.presses.end(), key) != input.presses.end();
}

#if IMGUI_VERSION_NUM >= 18700

void feed_keys(const WindowInput& input, ImGuiIO& io) {
    io.AddKeyEvent(ImGuiMod_Shift, input.shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, input.ctrl);
    io.AddKeyEvent(ImGuiMod_Alt, input.alt);
    for (const auto& [key, in_imgui] : panel_keys) io.AddKeyEvent(in_imgui, is_down(input, key));
}

#else

void feed_keys(const WindowInput& input, ImGuiIO& io) {
    io.KeyShift = input.shift;
    io.KeyCtrl = input.ctrl;
    io.KeyAlt = input.alt;
    for (const auto& [key, in_imgui] : panel_keys) io.KeysDown[in_imgui] = is_down(input, key);
    // It presses what has the focus by SPACE alone.
    if (io.KeysDown[ImGuiKey_Enter] && !io.WantTextInput) io.NavInputs[ImGuiNavInput_Activate] = 1.0f;
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

void feed_panel_input(const WindowInput& input, ImGuiIO& io) {
    constexpr float nowhere = -std::numeric_limits<float>::max();
    const glm::vec2 at(input.cursor * input.px_per_unit());
    io.MousePos = input.has_cursor ? ImVec2(at.x, at.y) : ImVec2(nowhere, nowhere);
    const auto is_held = [&](WindowInput::Button button) {
        return input.is_down[button] || input.went_down[button];
    };
    io.MouseDown[ImGuiMouseButton_Left] = is_held(WindowInput::left);
    io.MouseDown[ImGuiMouseButton_Right] = is_held(WindowInput::right);
    io.MouseDown[ImGuiMouseButton_Middle] = is_held(WindowInput::middle);
    io.MouseWheel += static_cast<float>(input.wheel.y);
    io.MouseWheelH += static_cast<float>(input.wheel.x);
    for (const char32_t character : input.typed) io.AddInputCharacter(character);
    feed_keys(input, io);
}

}  // namespace osteomill
