#include "render_client/ui/input/keyboard.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace osteomill {
namespace {

struct Row {
    const char* layout;
    int place;
    const char* printed;
    int meant;
};

TEST(KeyMeaning, IsWhatIsPrintedOnTheKey) {
    for (const Row& row : {Row{"US", GLFW_KEY_M, "m", GLFW_KEY_M},
                           Row{"US", GLFW_KEY_LEFT_BRACKET, "[", GLFW_KEY_LEFT_BRACKET},
                           Row{"US", GLFW_KEY_APOSTROPHE, "'", GLFW_KEY_UNKNOWN},
                           Row{"AZERTY", GLFW_KEY_SEMICOLON, "m", GLFW_KEY_M},
                           Row{"AZERTY", GLFW_KEY_M, ",", GLFW_KEY_COMMA},
                           Row{"AZERTY", GLFW_KEY_Q, "a", GLFW_KEY_A},
                           Row{"AZERTY", GLFW_KEY_A, "q", GLFW_KEY_Q},
                           Row{"AZERTY", GLFW_KEY_COMMA, ";", GLFW_KEY_UNKNOWN},
                           Row{"AZERTY", GLFW_KEY_1, "&", GLFW_KEY_1},
                           Row{"QWERTZ", GLFW_KEY_Y, "z", GLFW_KEY_Z},
                           Row{"QWERTZ", GLFW_KEY_Z, "y", GLFW_KEY_Y},
                           Row{"QWERTZ", GLFW_KEY_SLASH, "-", GLFW_KEY_MINUS},
                           Row{"QWERTZ", GLFW_KEY_RIGHT_BRACKET, "+", GLFW_KEY_EQUAL},
                           Row{"QWERTZ", GLFW_KEY_LEFT_BRACKET, "\xc3\xbc", GLFW_KEY_LEFT_BRACKET},
                           Row{"Dvorak", GLFW_KEY_S, "o", GLFW_KEY_O},
                           Row{"Russian", GLFW_KEY_M, "\xd1\x8c", GLFW_KEY_M},
                           Row{"none", GLFW_KEY_M, "", GLFW_KEY_M},
                           Row{"any", GLFW_KEY_SPACE, "", GLFW_KEY_SPACE},
                           Row{"any", GLFW_KEY_KP_ADD, "+", GLFW_KEY_KP_ADD},
                           Row{"any", GLFW_KEY_F1, "", GLFW_KEY_F1}})
        EXPECT_EQ(meant_key(row.place, row.printed), row.meant) << row.layout << ' ' << row.printed;
}

}  // namespace
}  // namespace osteomill
