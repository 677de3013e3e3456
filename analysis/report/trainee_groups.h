// Groups of trainees, from a teacher's file groups.csv, a line TRAINEE,GROUP each.
//
// Others are shown against the group "expert", also written "Experts" or as in German. A first line
// "trainee,group" is a heading. Lines may end as on any system; text that is no UTF-8 is read as
// Windows-1252, as Excel saves a CSV in western Europe.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace osteomill {

inline constexpr const char* expert_group = "expert";
inline constexpr const char* groups_file_name = "groups.csv";

struct TraineeGroup {
    std::string group;
    int line = 0;  ///< of the file, from 1

    bool operator==(const TraineeGroup&) const = default;
};

/// By the trainee's name. Throws std::runtime_error, with file and line, if the file cannot be read, a line
/// is not of two names, its heading has other columns, or a trainee is in two groups.
std::map<std::string, TraineeGroup> trainee_groups(const std::filesystem::path& file);

}  // namespace osteomill
