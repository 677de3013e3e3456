// Order of the pictures of a stack, by the numbers in their names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace osteomill {

/// Numbers within names count by their value: "2" before "10", "z0.25" before "z0.5", and "_-1" before "_0".
/// A hyphen behind a letter or digit is a minus where other names have none there ("s-1", "s0"); points are
/// of decimals unless they count ("1.9", "1.10"). Capitals count as small letters.
void sort_by_numbers(std::vector<std::filesystem::path>& files);

/// One line on the first place where files, in this order, are not numbered in steps as most of them are: a
/// slice may be missing, or one is too many. Empty if there is none, or most are not numbered at all.
std::string doubt_of_order(const std::vector<std::filesystem::path>& files);

}  // namespace osteomill
