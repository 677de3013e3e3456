// Measures all parts in alternation and says how they compare.
#pragma once

#include <filesystem>
#include <string>

namespace osteomill {

/// Starts `program` once for each part, `rounds` times over, and then for the references; prints a table to
/// standard output. Pictures go to `folder`, which must exist. Throws std::runtime_error with what a part
/// said where it failed.
void compare(const std::string& program, int rounds, int frames, const std::filesystem::path& folder);

}  // namespace osteomill
