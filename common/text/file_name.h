// A name of a file or folder made of a text that a person wrote, in whatever language.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/text/utf8.h"

namespace osteomill {

/// A file system takes 255 bytes, and a character may be four.
inline constexpr std::size_t longest_file_name_characters = 60;

constexpr bool is_separator(char letter) {
    return letter == '/' || letter == '\\';
}

/// The text, cut after longest_file_name_characters; separators, control characters and bytes that are no
/// UTF-8 become _. "." and "..", which are no names, become _ and __.
inline std::string as_file_name(std::string_view text) {
    const bool is_no_name = text == "." || text == "..";
    std::string name;
    for (std::size_t characters = 0; !text.empty() && characters < longest_file_name_characters;
         ++characters) {
        const Utf8Character next = first_character(text);
        if (!next.is_plain || is_separator(text.front()) || is_no_name)
            name += '_';
        else
            name += text.substr(0, next.bytes);
        text.remove_prefix(next.bytes);
    }
    return name;
}

}  // namespace osteomill
