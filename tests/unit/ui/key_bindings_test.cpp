#include "render_client/ui/input/key_bindings.h"

#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

namespace osteomill::key_bindings_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::array situations{Situation::drilling, Situation::playing, Situation::looking_on,
                                Situation::starting, Situation::waiting};

std::string text_of(const KeyBinding& binding) {
    return std::string(binding.name) + ": " + binding.meaning;
}

TEST(KeyBindings, GiveNoKeyTwoMeaningsInOneSituation) {
    for (const Situation situation : situations) {
        std::set<int> taken;
        for (const KeyBinding& binding : key_bindings())
            if (holds(binding, situation)) {
                for (const int key : binding.keys) EXPECT_TRUE(taken.insert(key).second) << binding.name;
            }
    }
}

TEST(KeyBindings, HelpShowsEachThatHoldsAndNoOther) {
    for (const Situation situation : situations) {
        std::set<std::string> shown, expected;
        for (const HelpLine& line : help_lines(situation)) shown.insert(line.name + ": " + line.meaning);
        for (const KeyBinding& binding : key_bindings())
            if (holds(binding, situation)) expected.insert(text_of(binding));
        for (const KeyBinding& binding : key_bindings())
            EXPECT_EQ(shown.count(text_of(binding)), expected.count(text_of(binding))) << text_of(binding);
    }
}

TEST(KeyBindings, HelpOfTheStartPageExplainsThatPage) {
    std::set<std::string> names;
    for (const HelpLine& line : help_lines(Situation::starting)) names.insert(line.name);
    for (const char* button :
         {"Start", "Import a scan ...", "Import labels ...", "Compare all sessions", "Tour", "F1"})
        EXPECT_TRUE(names.contains(button)) << button;
    for (const char* key : {"right drag", "F4", "F12"})
        EXPECT_FALSE(names.contains(key)) << key << ": there is nothing to look at yet";
}

TEST(KeyBindings, ReachEveryAction) {
    std::set<Action> reached;
    for (const KeyBinding& binding : key_bindings()) reached.insert(binding.action);
    for (int action = 0; action <= static_cast<int>(Action::on_5_s); ++action)
        EXPECT_EQ(reached.count(static_cast<Action>(action)), 1u) << action;
}

/// German and French keyboards bear [ ] only with another key held, French ones the point and the minus, too.
TEST(KeyBindings, ReachEveryActionByAKeyThatEveryKeyboardHas) {
    constexpr int first_without_sign = 256;  // GLFW_KEY_ESCAPE
    const auto is_everywhere = [](int key) {
        return key == ' ' || (key >= 'A' && key <= 'Z') || key >= first_without_sign;
    };
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.action != Action::none) {
            EXPECT_TRUE(std::ranges::any_of(binding.keys, is_everywhere)) << binding.name;
        }
    }
}

TEST(KeyBindings, NameTheKeyOfEveryAction) {
    EXPECT_EQ(key_of(Action::none), "");
    EXPECT_EQ(key_of(Action::undo), "U");
    EXPECT_EQ(key_of(Action::finish), "F10");
    EXPECT_EQ(key_of(Action::end), "ESC");
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.action == Action::none) continue;
        EXPECT_TRUE(std::string(binding.name).starts_with(key_of(binding.action)) ||
                    key_of(binding.action) == "=")
            << binding.name;
    }
}

TEST(KeyBindings, HaveTheKeysOfTheDocuments) {
    std::set<std::string> known;
    const std::regex key("F[0-9]+|[A-Z]+|[+-]");
    const auto keys_in = [&](const std::string& text) {
        return std::set<std::string>(std::sregex_token_iterator(text.begin(), text.end(), key), {});
    };
    for (const KeyBinding& binding : key_bindings()) known.merge(keys_in(binding.name));
    for (const char* document : {"README.md", "docs/microscope.md"}) {
        std::ifstream file(std::filesystem::path(REPOSITORY) / document);
        int keys = 0;
        bool is_in_table = false;
        for (std::string line; std::getline(file, line);) {
            is_in_table = line.starts_with("| key |") || (is_in_table && line.starts_with("|"));
            if (!is_in_table || line.starts_with("|--")) continue;
            for (const std::string& each : keys_in(line.substr(1, line.find('|', 1) - 1))) {
                EXPECT_TRUE(known.contains(each)) << document << ": " << each;
                ++keys;
            }
        }
        EXPECT_GE(keys, 6) << document;
    }
}

TEST(KeyBindings, MoveTheViewIfHeldAndNotIfTyped) {
    HeldViewMotion view;
    double now_s = 5.0;
    // "adeq", each key down for a tenth of a second, and the next one before it is up.
    for (int tenth = 0; tenth < 40; ++tenth, now_s += 0.05) {
        std::bitset<WindowInput::most_keys> down;
        down[static_cast<std::size_t>("ADEQ"[tenth / 2 % 4])] = true;
        down[static_cast<std::size_t>("ADEQ"[(tenth + 1) / 2 % 4])] = true;
        EXPECT_EQ(view.motion(down, now_s), glm::ivec2(0)) << tenth;
    }
    std::bitset<WindowInput::most_keys> right_and_down;
    right_and_down['D'] = right_and_down['Q'] = true;
    view.motion({}, now_s);
    EXPECT_EQ(view.motion(right_and_down, now_s), glm::ivec2(0));
    EXPECT_EQ(view.motion(right_and_down, now_s + HeldViewMotion::shortest_hold_s), glm::ivec2(1, 1));
    EXPECT_EQ(view.motion({}, now_s + 1.0), glm::ivec2(0));
}

TEST(KeyBindings, DependOnTheKindOfSession) {
    constexpr std::array<int, 1> space{' '};
    constexpr std::array<int, 2> cut_then_bracket{'X', ']'};
    EXPECT_THAT(actions_of(space, Situation::playing), ElementsAre(Action::play_or_pause));
    EXPECT_THAT(actions_of(space, Situation::drilling), IsEmpty()) << "the pedal is held, not pressed";
    EXPECT_THAT(actions_of(cut_then_bracket, Situation::drilling),
                ElementsAre(Action::cut_x, Action::next_burr));
    EXPECT_THAT(actions_of(cut_then_bracket, Situation::looking_on), ElementsAre(Action::cut_x));
}

}  // namespace
}  // namespace osteomill::key_bindings_test
