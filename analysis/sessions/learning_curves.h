// Learning curves of a case: each headline against the attempt, with its trend, and passes as a cumulative
// sum.
#pragma once

#include <string>
#include <vector>

#include "analysis/sessions/case_sessions.h"

namespace osteomill::study {

struct LearningCurve {
    std::string name;  ///< of a file: the metric's key
    std::string svg;
};

/// A line for each trainee; the fitted trend with its interval, the experts' band. Only of headlines that
/// some session has.
std::vector<LearningCurve> learning_curves(const CaseSessions& sessions);

/// A line for each trainee, with the levels at which the test decides; empty where no session was judged.
std::string pass_chart(const CaseSessions& sessions);

}  // namespace osteomill::study
