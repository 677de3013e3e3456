// The commit that a program was built from.
#pragma once

#include <string_view>

namespace osteomill {

/// Twelve digits or more, and a + if the sources differed from it; "unknown" if they were built outside of
/// git.
std::string_view built_from_commit();

}  // namespace osteomill
