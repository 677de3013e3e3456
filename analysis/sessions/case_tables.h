// Tables of the sessions of a case, as HTML.
#pragma once

#include <string>
#include <vector>

#include "analysis/sessions/case_sessions.h"

namespace osteomill::study {

/// A line a session, with a link to its report.
std::string session_table(const CaseSessions& sessions);

/// A line a headline: mean over trainees with its interval, the experts' band, the trend with practice; for
/// two groups their means, difference, effect size and p.
std::string statistics_table(const CaseSessions& sessions, const std::vector<std::string>& compared);

}  // namespace osteomill::study
