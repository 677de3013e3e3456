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

WindowInput WindowInput::take_after(std::size_t count) {
    WindowInput later = *this;
    later.forget_events();
    const auto first_press = presses.begin() + static_cast<std::ptrdiff_t>(std::min(count, presses.size()));
    later.presses.assign(first_press, presses.end());
    presses.erase(first_press, presses.end());
    auto first_character = std::ranges::find_if(
        typed, [&](const TypedCharacter& character) { return character.after_presses >= count; });
    // A key's own character comes behind its press.
    if (count > 0 && first_character != typed.end() && first_character->after_presses == count)
        ++first_character;
    later.typed.assign(first_character, typed.end());
    typed.erase(first_character, typed.end());
    for (TypedCharacter& character : later.typed) character.after_presses -= count;
    return later;
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
