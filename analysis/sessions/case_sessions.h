// The sessions of one case, in the order of their start, and what is asked of them together.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/headlines.h"
#include "analysis/sessions/session_record.h"
#include "analysis/statistics/mean_interval.h"
#include "analysis/statistics/practice_trend.h"

namespace osteomill::study {

struct Attempt {
    const SessionRecord* session = nullptr;
    int number = 1;  ///< of the trainee's sessions of the case, from 1
};

struct CaseSessions {
    std::string name;
    std::vector<Attempt> attempts{};
};

/// In the order in which the cases first come. The sessions outlive it.
std::vector<CaseSessions> cases_of(const std::vector<SessionRecord>& sessions);

/// Without those of experts, whose level and trend are others; all where all are of experts.
CaseSessions learners(const CaseSessions& sessions);

/// In the metric's own unit; nothing where the session has none.
std::optional<double> value_of(const SessionRecord& session, const Headline& what);

/// A value for each session that has one.
std::vector<PracticeValue> practice_of(const CaseSessions& sessions, const Headline& what);

/// A value for each trainee, the mean of their sessions: those of one trainee are not independent. `group`:
/// only of its trainees; empty: all.
std::vector<double> trainee_means(const CaseSessions& sessions, const Headline& what,
                                  const std::string& group = {});

/// Where the middle half of the experts' sessions lies; nothing for fewer than four.
std::optional<Interval> expert_band(const CaseSessions& sessions, const Headline& what);

/// Whether each judged session passed, by trainee.
std::map<std::string, std::vector<bool>> passes_of(const CaseSessions& sessions);

}  // namespace osteomill::study
