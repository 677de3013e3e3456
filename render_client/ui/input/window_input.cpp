#include "render_client/ui/input/window_input.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace osteomill {

std::vector<int> WindowInput::pressed_keys() const {
    std::vector<int> keys;
    for (const KeyPress& press : presses) keys.push_back(press.key);
    return keys;
}

void WindowInput::append(const WindowInput& later) {
    const WindowInput before = std::exchange(*this, later);
    for (std::size_t i = 0; i < buttons; ++i) {
        went_down[i] = went_down[i] || before.went_down[i];
        if (!pressed_at[i]) pressed_at[i] = before.pressed_at[i];
        if (!released_at[i]) released_at[i] = before.released_at[i];
    }
    const bool clicked_before = std::ranges::any_of(before.went_down, std::identity{});
    for (TypedCharacter& character : typed) {
        character.after_presses += before.presses.size();
        character.after_click = character.after_click || clicked_before;
    }
    presses.insert(presses.begin(), before.presses.begin(), before.presses.end());
    typed.insert(typed.begin(), before.typed.begin(), before.typed.end());
    wheel += before.wheel;
    has_news = has_news || before.has_news;
}

void WindowInput::forget_events() {
    went_down = {};
    pressed_at = {};
    released_at = {};
    presses.clear();
    typed.clear();
    wheel = glm::dvec2(0.0);
    has_news = false;
}

}  // namespace osteomill
