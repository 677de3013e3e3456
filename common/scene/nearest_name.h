// The valid name nearest to a mistyped one, for error messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osteomill {

/// Single-character insertions, deletions and replacements that turn one word into the other (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name closest to `written`, if one is close: one begins with the other (three letters or more, such as
/// "speed" for "speed_mm_per_s"), or no more than half of the longer one's letters differ.
std::optional<std::string> nearest_name(std::string_view written, const std::vector<std::string>& names);

/// The name as written, or else the only one that differs merely in blanks and underscores, which tables of
/// colours exchange for one another.
std::optional<std::string> same_name(std::string_view written, const std::vector<std::string>& names);

}  // namespace osteomill
