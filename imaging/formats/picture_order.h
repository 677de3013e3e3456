// Order of the pictures of a stack, by the numbers in their names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace osteomill {

/// Numbers within names count by their value, "2" before "10", and "_-1" (a minus that no letter or digit
/// precedes) before "_0"; capitals count as small letters.
bool comes_before(const std::filesystem::path& a, const std::filesystem::path& b);

/// One line on the first place where files, in this order, are not numbered in steps as most of them are: a
/// slice may be missing, or one is too many. Empty where there is none, or most are not numbered at all.
std::string doubt_of_order(const std::vector<std::filesystem::path>& files);

}  // namespace osteomill
