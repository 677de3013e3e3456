// Reference sessions: others of the same case, begun alike (start_conditions.h), against which a report shows
// its numbers. Their reports lie in folders beside its own.
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
