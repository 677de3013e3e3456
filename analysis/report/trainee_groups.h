// Groups of trainees, from a teacher's file groups.csv, a line TRAINEE,GROUP each.
//
// Others are shown against the group "expert". A first line "trainee,group" is a heading.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace osteomill {

inline constexpr const char* expert_group = "expert";
inline constexpr const char* groups_file_name = "groups.csv";

/// By the trainee's name. Throws std::runtime_error, with file and line, where it cannot be read, a line is
/// not of two names, or a trainee is in two groups.
std::map<std::string, std::string> trainee_groups(const std::filesystem::path& file);

}  // namespace osteomill
