// State of a window's mouse and keyboard, and of the window itself: plain data, for a thread that
// draws and one that drills. Mouse in units of the window, y down.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace osteomill {

/// Each notch of the wheel makes the view so many times as wide.
inline constexpr double zoom_per_notch = 0.88;

/// A key of GLFW that went down, with the modifiers held then.
struct KeyPress {
    int key = 0;
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const KeyPress&) const = default;
};

/// A character, as the keyboard's layout makes it.
struct TypedCharacter {
    TypedCharacter(char32_t is, std::size_t presses_before = 0, bool comes_after_click = false)
        : character(is), after_presses(presses_before), after_click(comes_after_click) {}
    char32_t character;
    std::size_t after_presses;  ///< so many of the same input's keys went down before
    bool after_click;           ///< a button of the mouse went down before
};

struct WindowInput {
    static constexpr std::size_t most_keys = 512;  ///< GLFW numbers fewer
    enum Button : std::size_t { left, right, middle, buttons };

    // The state now.
    glm::dvec2 cursor{0.0};
    bool has_cursor = false;  ///< over the window, or dragged out of it
    std::array<bool, buttons> is_down{};
    std::bitset<most_keys> keys_down{};
    bool shift = false, ctrl = false, alt = false;
    bool is_focused = false;
    bool is_minimised = false;
    glm::dvec2 size{1.0};
    glm::ivec2 framebuffer_size_px{1, 1};
    double content_scale = 1.0;

    // Since it was last taken.
    std::array<bool, buttons> went_down{};  ///< though it may be up again
    /// Where it last went down, and up: the cursor may be elsewhere by now.
    std::array<std::optional<glm::dvec2>, buttons> pressed_at{}, released_at{};
    std::vector<KeyPress> presses{};  ///< though the key may be up again
    std::vector<TypedCharacter> typed{};
    glm::dvec2 wheel{0.0};  ///< notches
    bool has_news = false;  ///< anything happened, or part of the window has to be shown anew

    /// Pixels of the picture in a unit of the window.
    glm::dvec2 px_per_unit() const { return glm::dvec2(framebuffer_size_px) / size; }
    std::vector<int> pressed_keys() const;
    /// Appends later input: takes its state, and keeps the events of both.
    void append(const WindowInput& later);
    /// Takes out the keys behind the first `count`, and what they typed; the state is in both.
    WindowInput take_after(std::size_t count);
    /// The state stays, the events go.
    void forget_events();
};

}  // namespace osteomill
