// Start conditions of a session, as far as a trainee feels them: only sessions that began alike are attempts
// at the same task, and only they are compared.
#pragma once

#include <map>
#include <string>

#include "analysis/report/session_trace.h"

namespace osteomill {

struct StartConditions {
    std::string bone;                             ///< digest of the bone, its tissues and its stiffness
    std::map<std::string, std::string> settings;  ///< those that are felt; settings that are off are left out

    bool operator==(const StartConditions&) const = default;
};

/// The settings of a session that a trainee feels.
std::map<std::string, std::string> felt_settings(const std::map<std::string, std::string>& settings);

StartConditions start_conditions(const SessionTrace& trace);

}  // namespace osteomill
