#include "analysis/sessions/overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "analysis/report/html_text.h"
#include "analysis/report/page_style.h"
#include "analysis/sessions/case_tables.h"
#include "common/text/csv_cell.h"

namespace osteomill::study {

namespace {

/// Those with a session.
std::set<std::string> groups_in(const std::vector<SessionRecord>& sessions) {
    std::set<std::string> groups;
    for (const SessionRecord& session : sessions)
        if (!session.group.empty()) groups.insert(session.group);
    return groups;
}

constexpr const char* methods =
    "<p class='about'>Means are over trainees: each counts once, by the mean of their sessions. Intervals "
    "are "
    "of 95 %. The trend is y = a<sub>trainee</sub> + b ln(attempt), by least squares: a level for each "
    "trainee, one slope for all; the black line is that of the trainees at their mean level, grey its "
    "interval. Experts count in neither. Groups: Welch's t and Hedges' g for measures, Mann and Whitney's "
    "exact test and Cliff's δ for "
    "counts; p is not corrected for the number of lines.</p>";

constexpr const char* pass_method =
    "<p class='about'>A failure raises the line, a pass lowers it. Where it has fallen from a level by as "
    "much "
    "as the lower dashed line is below zero, the trainee fails no more than that share (error 10 %); where "
    "it "
    "has risen by as much as the upper one, no less.</p>";

}  // namespace

std::string sessions_csv(const std::vector<SessionRecord>& sessions) {
    std::string csv = "session,trainee,case,attempt,began_unix_s,metric,of,value,unit\n";
    std::map<const SessionRecord*, int> attempts;
    const std::vector<CaseSessions> cases = cases_of(sessions);
    for (const CaseSessions& one : cases)
        for (const Attempt& attempt : one.attempts) attempts[attempt.session] = attempt.number;
    for (const SessionRecord& session : sessions)
        for (const MetricRow& metric : session.metrics)
            csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(session.file),
                               csv_cell(session.trainee), csv_cell(session.case_name), attempts[&session],
                               session.began_unix_ns / 1'000'000'000, metric.key, csv_cell(metric.of),
                               metric.value ? fmt::format("{:.9g}", *metric.value) : "", metric.unit);
    return csv;
}

Overview::Overview(const std::vector<SessionRecord>& sessions, std::vector<std::string> compared)
    : cases_(cases_of(sessions)), compared_(std::move(compared)), count_(sessions.size()) {
    const std::set<std::string> groups = groups_in(sessions);
    if (compared_.empty() && groups.size() == 2) compared_.assign(groups.begin(), groups.end());
    for (const std::string& group : compared_)
        if (!groups.contains(group))
            throw std::runtime_error(
                fmt::format("no session is of a trainee in group \"{}\"; {}", group,
                            groups.empty() ? "there are no groups: write groups.csv, with lines TRAINEE,GROUP"
                                           : fmt::format("take one of \"{}\"", fmt::join(groups, "\", \""))));
}

std::vector<LearningCurve> Overview::learning_curves() const {
    std::vector<LearningCurve> all;
    for (std::size_t i = 0; i < cases_.size(); ++i)
        for (LearningCurve& curve : study::learning_curves(cases_[i])) {
            if (i > 0) curve.name += fmt::format("_{}", i + 1);
            all.push_back(std::move(curve));
        }
    return all;
}

std::string Overview::html(const std::vector<std::string>& skipped) const {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><meta "
        "http-equiv='Content-Security-Policy' "
        "content=\"default-src 'none'; style-src 'unsafe-inline'\"><title>Osteomill: sessions</title>"
        "<style>{}body{{max-width:1300px}}@page{{size:landscape}}</style></head><body><h1>{} sessions</h1>",
        page_style, count_);
    for (const std::string& line : skipped)
        html += fmt::format("<p class='wrong'>Left out: {}</p>", html_text(line));
    for (const CaseSessions& one : cases_) {
        html += fmt::format("<h2>{}</h2>", html_text(one.name)) + session_table(one) + "<h3>Together</h3>" +
                statistics_table(one, compared_) + methods + "<h3>Learning curves</h3>";
        for (const LearningCurve& curve : study::learning_curves(one)) html += curve.svg;
        if (const std::string chart = pass_chart(one); !chart.empty()) html += chart + pass_method;
    }
    return html +
           "<footer>What each number means: docs/metrics.md. All metrics: "
           "sessions.csv.</footer></body></html>\n";
}

}  // namespace osteomill::study
