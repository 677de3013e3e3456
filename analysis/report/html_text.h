// Text from strangers (names, notes) as HTML or SVG shows it and nothing else.
#pragma once

#include <string>
#include <string_view>

namespace osteomill {

/// Markup is escaped, control characters become spaces, and bytes that are no UTF-8 the replacement sign.
std::string html_text(std::string_view text);

}  // namespace osteomill
