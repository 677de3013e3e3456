#include "render_client/ui/input/keyboard.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <utility>

namespace osteomill {

namespace {

/// Signs that are bound, and "+", which shares its US key with "=".
constexpr std::array signs{std::pair{'[', GLFW_KEY_LEFT_BRACKET}, std::pair{']', GLFW_KEY_RIGHT_BRACKET},
                           std::pair{',', GLFW_KEY_COMMA},        std::pair{'.', GLFW_KEY_PERIOD},
                           std::pair{'-', GLFW_KEY_MINUS},        std::pair{'=', GLFW_KEY_EQUAL},
                           std::pair{'+', GLFW_KEY_EQUAL}};

}  // namespace

int meant_key(int key, std::string_view printed) {
    // GLFW numbers them as ASCII does; from ESC on are keys that bear no character.
    if (key <= GLFW_KEY_SPACE || key >= GLFW_KEY_ESCAPE || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9))
        return key;
    if (printed.size() != 1 || static_cast<unsigned char>(printed.front()) >= 0x80) return key;
    const char sign = printed.front();
    if (sign >= 'a' && sign <= 'z') return GLFW_KEY_A + (sign - 'a');
    if (sign >= 'A' && sign <= 'Z') return GLFW_KEY_A + (sign - 'A');
    for (const auto& [bound, place] : signs)
        if (sign == bound) return place;
    return GLFW_KEY_UNKNOWN;
}

}  // namespace osteomill
