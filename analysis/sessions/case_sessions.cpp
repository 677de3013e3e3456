#include "analysis/sessions/case_sessions.h"

#include <algorithm>

#include "analysis/report/reference_sessions.h"
#include "analysis/report/trainee_groups.h"

namespace osteomill::study {

std::vector<CaseSessions> cases_of(const std::vector<SessionRecord>& sessions) {
    std::vector<CaseSessions> cases;
    for (const SessionRecord& session : sessions) {
        auto of_case = std::ranges::find(cases, session.case_name, &CaseSessions::name);
        if (of_case == cases.end()) of_case = cases.insert(cases.end(), {session.case_name});
        const auto before = std::ranges::count_if(of_case->attempts, [&](const Attempt& attempt) {
            return attempt.session->trainee == session.trainee;
        });
        of_case->attempts.push_back({&session, static_cast<int>(before) + 1});
    }
    return cases;
}

CaseSessions learners(const CaseSessions& sessions) {
    CaseSessions some{sessions.name, sessions.attempts};
    std::erase_if(some.attempts, [](const Attempt& one) { return one.session->group == expert_group; });
    return some.attempts.empty() ? sessions : some;
}

std::optional<double> value_of(const SessionRecord& session, const Headline& what) {
    return sum_of(session.metrics, what.key);
}

std::vector<PracticeValue> practice_of(const CaseSessions& sessions, const Headline& what) {
    std::vector<PracticeValue> values;
    for (const Attempt& attempt : sessions.attempts)
        if (const auto value = value_of(*attempt.session, what))
            values.push_back({attempt.session->trainee, attempt.number, *value});
    return values;
}

std::vector<double> trainee_means(const CaseSessions& sessions, const Headline& what,
                                  const std::string& group) {
    std::map<std::string, std::vector<double>> of_trainee;
    for (const Attempt& attempt : sessions.attempts)
        if (group.empty() || attempt.session->group == group)
            if (const auto value = value_of(*attempt.session, what))
                of_trainee[attempt.session->trainee].push_back(*value);
    std::vector<double> means;
    for (const auto& [trainee, values] : of_trainee) means.push_back(mean_of(values));
    return means;
}

std::optional<Interval> expert_band(const CaseSessions& sessions, const Headline& what) {
    std::vector<double> values;
    for (const Attempt& attempt : sessions.attempts)
        if (const auto value = value_of(*attempt.session, what);
            value && attempt.session->group == expert_group)
            values.push_back(*value);
    return middle_half(values);
}

std::map<std::string, std::vector<bool>> passes_of(const CaseSessions& sessions) {
    std::map<std::string, std::vector<bool>> passes;
    for (const Attempt& attempt : sessions.attempts)
        if (const auto passed = sum_of(attempt.session->metrics, "passed"))
            passes[attempt.session->trainee].push_back(*passed != 0.0);
    return passes;
}

}  // namespace osteomill::study
