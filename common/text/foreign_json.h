// JSON from elsewhere, whose depth is bounded before it is parsed. Code that walks through a value afterwards
// (to flatten, copy or print it) calls itself once a level, so a file of brackets alone would use up the
// stack.
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace osteomill {

/// Many times the depth of any file of this project.
inline constexpr std::size_t deepest_json = 100;

/// How deep lists and objects are nested; some upper bound if the text is no JSON.
inline std::size_t depth_of_json(std::string_view text) {
    std::size_t depth = 0;
    std::size_t deepest = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (in_text && letter == '\\')
            ++i;  // the next character ends no text
        else if (letter == '"')
            in_text = !in_text;
        else if (!in_text && (letter == '[' || letter == '{'))
            deepest = std::max(deepest, ++depth);
        else if (!in_text && (letter == ']' || letter == '}') && depth > 0)
            --depth;
    }
    return deepest;
}

/// Throws std::runtime_error in one line that begins with `name` if the text is too deep, and
/// nlohmann::json::exception if it is no JSON.
template <typename Json = nlohmann::json>
Json parse_foreign_json(std::string_view text, const std::string& name) {
    if (depth_of_json(text) > deepest_json)
        throw std::runtime_error(name + ": its lists and objects lie more than " +
                                 std::to_string(deepest_json) + " deep in one another");
    return Json::parse(text);
}

}  // namespace osteomill
