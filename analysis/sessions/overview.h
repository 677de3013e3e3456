// Several sessions side by side: a tidy CSV, and a page of tables, statistics and learning curves.
#pragma once

#include <string>
#include <vector>

#include "analysis/sessions/learning_curves.h"
#include "analysis/sessions/session_record.h"

namespace osteomill::study {

/// session,trainee,case,attempt,began_unix_s,metric,of,value,unit: a line a session and metric. `session` is
/// the recording's file; `attempt` counts a trainee's sessions of a case from 1, in the order of `sessions`.
std::string sessions_csv(const std::vector<SessionRecord>& sessions);

class Overview {
  public:
    /// `sessions` in the order of their start; they outlive it. `compared`: two groups, or none: then those
    /// that there are, if they are two. Throws std::runtime_error for a group without a session.
    Overview(const std::vector<SessionRecord>& sessions, std::vector<std::string> compared);

    /// Of each case.
    std::vector<LearningCurve> learning_curves() const;
    /// For each case a table with a line a session, what the sessions say together, the learning curves and
    /// the chart of passes; above all what was left out and why.
    std::string html(const std::vector<std::string>& skipped) const;

  private:
    std::vector<CaseSessions> cases_;
    std::vector<std::string> compared_;
    std::size_t count_;
};

}  // namespace osteomill::study
