// Formatted text behind a text, in place: as by fmt::format_to, which every object compiles anew (3 s), where
// this is compiled once.
#pragma once

#include <fmt/format.h>

#include <string>

namespace osteomill {

void append_values(std::string& text, fmt::string_view format, fmt::format_args values);
void append_values(fmt::memory_buffer& text, fmt::string_view format, fmt::format_args values);

/// `Text`: std::string or fmt::memory_buffer. It allocates only to grow.
template <typename Text, typename... Values>
void append_formatted(Text& text, fmt::format_string<Values...> format, Values&&... values) {
    append_values(text, format, fmt::make_format_args(values...));
}

}  // namespace osteomill
