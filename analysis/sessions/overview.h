// Several sessions as tables and learning curves: a page, charts, and a tidy CSV.
#pragma once

#include <string>
#include <vector>

#include "analysis/sessions/session_record.h"

namespace osteomill::study {

/// session,trainee,case,attempt,began_unix_s,metric,of,value,unit: a line a session and metric. `session` is
/// the recording's file; `attempt` counts a trainee's sessions of a case from 1, in the order of `sessions`.
std::string sessions_csv(const std::vector<SessionRecord>& sessions);

struct LearningCurve {
    std::string key;  ///< the metric's
    std::string svg;
};

/// A metric against the attempt, a line for each trainee and case. Only metrics that some session has.
std::vector<LearningCurve> learning_curves(const std::vector<SessionRecord>& sessions);

/// A table for each case, a line a session; the learning curves; what was left out and why.
std::string overview_html(const std::vector<SessionRecord>& sessions,
                          const std::vector<std::string>& skipped);

}  // namespace osteomill::study
