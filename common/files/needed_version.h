// The version of Osteomill that a file needs. If older versions cannot read a file, its writer states the
// version that can, under one key that every reader checks first (docs/compatibility.md). This version writes
// files that 0.3 reads, and so no such key.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace osteomill {

/// The key in scenes; bone files have it as osteomill_needs.
inline constexpr const char* needed_version_key = "needs";

/// The end of a line for people, "needs Osteomill 0.4 or later, this is 0.3.0", if `needed`, such as "0.4" or
/// "1.2.3", is above this program's version, or if it is no version at all.
std::optional<std::string> why_not_for_this_version(std::string_view needed);

}  // namespace osteomill
