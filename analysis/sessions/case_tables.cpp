#include "analysis/sessions/case_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/html_text.h"
#include "analysis/report/page_style.h"
#include "analysis/statistics/group_comparison.h"

namespace osteomill::study {

namespace {

constexpr const char* none = "–";

std::string cell(const std::string& text) {
    return "<td class='n'>" + text + "</td>";
}

std::string number(const Headline& what, double value) {
    return shown_value(what.key, value).number;
}

std::string interval_text(const Headline& what, const Interval& interval) {
    return fmt::format("{} to {}", number(what, interval.low), number(what, interval.high));
}

std::string with_interval(const Headline& what, double value, const Interval& interval) {
    return fmt::format("{} [{}]", number(what, value), interval_text(what, interval));
}

std::string p_text(double p) {
    return p < 0.001 ? "&lt; 0.001" : fmt::format("{:.3f}", p);
}

std::string heading_of(const Headline& what) {
    return fmt::format("{}{}", what.text, *what.unit == '\0' ? "" : fmt::format(" ({})", what.unit));
}

std::string mean_cells(const CaseSessions& sessions, const Headline& what) {
    const auto mean = mean_interval(trainee_means(learners(sessions), what));
    if (!mean) return cell("0") + cell(none);
    return cell(std::to_string(mean->n)) +
           cell(mean->interval ? with_interval(what, mean->mean, *mean->interval) : number(what, mean->mean));
}

/// Of a doubling of attempts.
std::string trend_cells(const CaseSessions& sessions, const Headline& what) {
    const auto trend = practice_trend(practice_of(learners(sessions), what));
    if (!trend) return cell(none) + cell(none);
    const double doubling = std::log(2.0);
    const Interval slope = trend->slope_interval();
    return cell(with_interval(what, doubling * trend->slope(),
                              {doubling * slope.low, doubling * slope.high})) +
           cell(p_text(trend->p()));
}

std::string comparison_cells(const CaseSessions& sessions, const Headline& what,
                             const std::vector<std::string>& compared) {
    const std::vector<double> first = trainee_means(sessions, what, compared[0]);
    const std::vector<double> second = trainee_means(sessions, what, compared[1]);
    std::string cells;
    for (const auto& group : {first, second})
        cells +=
            cell(group.empty() ? none : fmt::format("{} ({})", number(what, mean_of(group)), group.size()));
    if (what.is_count) {
        const auto ranks = compare_ranks(first, second);
        return cells + cell(none) +
               (ranks ? cell(fmt::format("δ {:.2f}", ranks->cliffs_delta)) + cell(p_text(ranks->p)) +
                            "<td>Mann-Whitney</td>"
                      : cell(none) + cell(none) + "<td></td>");
    }
    const auto welch = compare_means(first, second);
    if (!welch) return cells + cell(none) + cell(none) + cell(none) + "<td></td>";
    return cells + cell(with_interval(what, welch->difference, welch->interval)) +
           cell(fmt::format("g {:.2f}", welch->hedges_g)) + cell(p_text(welch->p)) + "<td>Welch</td>";
}

}  // namespace

std::string session_table(const CaseSessions& sessions) {
    std::vector<Headline> columns;
    const bool is_judged = std::ranges::any_of(sessions.attempts, [](const Attempt& attempt) {
        return sum_of(attempt.session->metrics, "passed").has_value();
    });
    for (const Headline& what : headlines)
        if (!practice_of(sessions, what).empty()) columns.push_back(what);
    std::string html =
        fmt::format("<table class='wide'><tr><th>trainee</th><th class='n'>attempt</th><th>began</th>{}",
                    is_judged ? "<th>passed</th>" : "");
    for (const Headline& what : columns) html += fmt::format("<th class='n'>{}</th>", heading_of(what));
    html += "</tr>";
    std::vector<Attempt> order = sessions.attempts;
    std::ranges::stable_sort(order, {}, [](const Attempt& attempt) { return attempt.session->trainee; });
    for (const Attempt& attempt : order) {
        const SessionRecord& session = *attempt.session;
        std::string began = local_time_text(session.began_unix_ns);
        if (!session.report.empty())
            began = fmt::format("<a href='{}'>{}</a>", session.report, began.empty() ? "report" : began);
        html += fmt::format("<tr><td title='{}'>{}{}</td><td class='n'>{}</td><td class='w'>{}</td>",
                            html_text(session.file), html_text(session.trainee),
                            session.group.empty() ? "" : " (" + html_text(session.group) + ")",
                            attempt.number, began);
        if (is_judged) {
            const auto passed = sum_of(session.metrics, "passed");
            html += !passed          ? "<td></td>"
                    : *passed != 0.0 ? "<td class='yes'>✓ yes</td>"
                                     : "<td class='no'>✗ no</td>";
        }
        for (const Headline& what : columns) {
            const auto value = value_of(session, what);
            html += cell(value ? number(what, *value) : none);
        }
        html += "</tr>";
    }
    return html + "</table>";
}

std::string statistics_table(const CaseSessions& sessions, const std::vector<std::string>& compared) {
    std::string html =
        "<table class='wide'><tr><th></th><th></th><th class='n'>trainees</th><th class='n'>mean [95 %]</th>"
        "<th class='n'>middle half of experts</th><th class='n'>change per doubling of attempts [95 %]</th>"
        "<th class='n'>p</th>";
    if (!compared.empty())
        html += fmt::format(
            "<th class='n'>{} (n)</th><th class='n'>{} (n)</th><th class='n'>difference [95 %]</th>"
            "<th class='n'>effect</th><th class='n'>p</th><th>test</th>",
            html_text(compared[0]), html_text(compared[1]));
    html += "</tr>";
    for (const Headline& what : headlines) {
        if (practice_of(sessions, what).empty()) continue;
        const auto band = expert_band(sessions, what);
        html += fmt::format("<tr><td>{}</td><td>{}</td>", heading_of(what), text_of(what.better)) +
                mean_cells(sessions, what) + cell(band ? interval_text(what, *band) : none) +
                trend_cells(sessions, what);
        if (!compared.empty()) html += comparison_cells(sessions, what, compared);
        html += "</tr>";
    }
    return html + "</table>";
}

}  // namespace osteomill::study
