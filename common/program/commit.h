// The commit that a program was built from.
#pragma once

#include <string_view>

namespace osteomill {

/// Twelve digits or more, and a + where the sources differed from it; "unknown" where they were built outside
/// of git.
std::string_view built_from_commit();

}  // namespace osteomill
