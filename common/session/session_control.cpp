#include "common/session/session_control.h"

#include <array>

namespace osteomill {

const char* name_of(SessionAction action) {
    constexpr std::array names{"nothing", "mark", "pause",  "resume", "undo",  "redo",
                               "reset",   "save", "finish", "place",  "speed", "fixture"};
    static_assert(names.size() == static_cast<std::size_t>(SessionAction::fixture) + 1);
    const auto number = static_cast<std::size_t>(action);
    return names[number < names.size() ? number : 0];
}

}  // namespace osteomill
