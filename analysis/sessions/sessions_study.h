// Sessions of several trainees side by side: a table a line a session and metric, learning curves, an
// overview.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct SessionsStudyOptions {
    std::vector<std::filesystem::path> from;  ///< recordings; folders that hold some, or folders of reports
    std::filesystem::path out = "study/sessions";
    std::filesystem::path groups{};      ///< of the trainees (trainee_groups.h); empty: see groups_file
    std::vector<std::string> compare{};  ///< two groups; empty: those that there are, if they are two
    std::string database{};              ///< a department's (department_database.h); empty: none
    std::string version;
};

/// Writes OUT/sessions.sqlite, sessions.csv, sessions.html and a learning curve OUT/KEY.svg for each
/// metric that is drawn (KEY_2.svg for the second case, ...). A recording that cannot be read to its end is
/// named and left out. With a database, the sessions are added to that, too. Throws std::runtime_error where
/// none is left, a file cannot be read or written, or a group to compare has no session.
void run_sessions_study(const SessionsStudyOptions& options, const StudySurroundings& surroundings);

/// The groups.csv in the first of the folders that holds one; empty where none does.
std::filesystem::path groups_file(const std::vector<std::filesystem::path>& from);

/// Recordings that are meant: a file itself; of a folder DIR all DIR/*.pcap and DIR/*/session.pcap, whole
/// ones only. In the order of their paths, each once. Throws std::runtime_error for what is neither file nor
/// folder, and for a folder without any.
std::vector<std::filesystem::path> recordings_in(const std::vector<std::filesystem::path>& from);

}  // namespace osteomill::study
