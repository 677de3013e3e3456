// The translations beside this file (de.toml), as they are built into the program.
#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace osteomill {

/// Language and text.
std::span<const std::pair<std::string_view, std::string_view>> embedded_words();

}  // namespace osteomill
