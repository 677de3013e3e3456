// Reference sessions: others of the same case, begun alike (StartConditions), against which a report
// shows its numbers. Their reports lie in folders beside its own.
//
// They are the experts' sessions if at least four are of trainees whom groups.csv beside them puts into the
// group "expert"; else all sessions, if there are at least four. Their numbers are read from metrics.json.
// Incomplete sessions are left out, and so is the same session, reported elsewhere. A report that cannot be
// read is no reference.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

/// Start conditions of a session, as far as a trainee feels them: only sessions that began alike are attempts
/// at the same task, and only they are compared.
struct StartConditions {
    std::string bone;                             ///< digest of the bone, its tissues and its stiffness
    std::map<std::string, std::string> settings;  ///< those that are felt; settings that are off are left out

    bool operator==(const StartConditions&) const = default;
};

/// The settings of a session that a trainee feels.
std::map<std::string, std::string> felt_settings(const std::map<std::string, std::string>& settings);

StartConditions start_conditions(const SessionTrace& trace);

// Groups of trainees, from a teacher's file groups.csv, a line TRAINEE,GROUP each.
//
// Others are shown against the group "expert", also written "Experts" or as in German. A first line
// "trainee,group" is a heading. Lines may end as on any system; text that is no UTF-8 is read as
// Windows-1252, as Excel saves a CSV in western Europe.

inline constexpr const char* expert_group = "expert";
inline constexpr const char* groups_file_name = "groups.csv";

struct TraineeGroup {
    std::string group;
    int line = 0;  ///< of the file, from 1

    bool operator==(const TraineeGroup&) const = default;
};

/// By the trainee's name. Throws std::runtime_error, with file and line, if the file cannot be read, a line
/// is not of two names, its heading or a line with semicolons has other columns, or a trainee is in two
/// groups.
std::map<std::string, TraineeGroup> trainee_groups(const std::filesystem::path& file);

inline constexpr std::size_t fewest_references = 4;

struct ValueBand {
    double low = 0.0;
    double high = 0.0;
};

/// The band of the middle half of some values: from the first quartile to the third (percentile.h). Nothing
/// for fewer than fewest_references.
std::optional<ValueBand> middle_half(std::span<const double> values);

struct ReferenceSessions {
    bool are_experts = false;
    std::map<std::string, std::vector<double>> values{};  ///< by headline's key
};

/// `folder`: of the report.
ReferenceSessions reference_sessions(const std::filesystem::path& folder, const SessionTrace& trace);

}  // namespace osteomill
