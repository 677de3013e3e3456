#include "analysis/sessions/overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "analysis/report/html_text.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/report_html.h"
#include "analysis/report/svg_plot.h"
#include "common/text/csv_cell.h"

namespace osteomill::study {

namespace {

/// What is compared at a glance; the CSV has all.
struct Compared {
    const char* key;
    const char* text;
    const char* unit;
    double scale = 1.0;
};
constexpr std::array<Compared, 9> compared{{{"time_s", "time", "s"},
                                            {"removed_mm3", "removed", "mm³"},
                                            {"plan_removed_share", "of the plan", "%", 100.0},
                                            {"plan_excess_mm3", "beyond the margin", "mm³"},
                                            {"plan_surface_mean_mm", "surface distance", "mm"},
                                            {"structure_touches", "touches of protected structures", ""},
                                            {"peak_force_n", "peak force", "N"},
                                            {"path_mm", "path of the hand", "mm"},
                                            {"stroke_smoothness_ldlj", "smoothness of strokes", ""}}};

std::optional<double> value_of(const SessionRecord& session, const Compared& what) {
    const auto value = session.sum(what.key);
    return value ? std::optional(what.scale * *value) : std::nullopt;
}

/// Counted from 1 for each trainee and case.
std::vector<int> attempts_of(const std::vector<SessionRecord>& sessions) {
    std::map<std::pair<std::string, std::string>, int> counts;
    std::vector<int> attempts;
    for (const SessionRecord& session : sessions)
        attempts.push_back(++counts[{session.trainee, session.case_name}]);
    return attempts;
}

bool is_of_several_cases(const std::vector<SessionRecord>& sessions) {
    return std::ranges::any_of(sessions, [&](const SessionRecord& session) {
        return session.case_name != sessions.front().case_name;
    });
}

std::string table(const std::vector<SessionRecord>& sessions, const std::string& case_name) {
    std::string html = "<table><tr><th>trainee</th><th class='n'>attempt</th><th>began</th>";
    for (const Compared& what : compared)
        html += fmt::format("<th class='n'>{}{}</th>", what.text,
                            *what.unit == '\0' ? "" : fmt::format(" ({})", what.unit));
    html += "</tr>";
    const std::vector<int> attempts = attempts_of(sessions);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < sessions.size(); ++i)
        if (sessions[i].case_name == case_name) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sessions[i].trainee; });
    for (const std::size_t i : order) {
        html += fmt::format("<tr><td title='{}'>{}</td><td class='n'>{}</td><td>{}</td>",
                            html_text(sessions[i].file), html_text(sessions[i].trainee), attempts[i],
                            began_text(sessions[i].began_unix_ns));
        for (const Compared& what : compared) {
            const auto value = value_of(sessions[i], what);
            html += fmt::format("<td class='n'>{}</td>", value ? number_text(*value) : "–");
        }
        html += "</tr>";
    }
    return html + "</table>";
}

}  // namespace

std::string sessions_csv(const std::vector<SessionRecord>& sessions) {
    std::string csv = "session,trainee,case,attempt,began_unix_s,metric,of,value,unit\n";
    const std::vector<int> attempts = attempts_of(sessions);
    for (std::size_t i = 0; i < sessions.size(); ++i)
        for (const KeptMetric& metric : sessions[i].metrics)
            csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(sessions[i].file),
                               csv_cell(sessions[i].trainee), csv_cell(sessions[i].case_name), attempts[i],
                               sessions[i].began_unix_ns / 1'000'000'000, metric.key, csv_cell(metric.of),
                               metric.value ? fmt::format("{:.9g}", *metric.value) : "", metric.unit);
    return csv;
}

std::vector<LearningCurve> learning_curves(const std::vector<SessionRecord>& sessions) {
    const std::vector<int> attempts = attempts_of(sessions);
    const bool names_cases = is_of_several_cases(sessions);
    std::vector<LearningCurve> curves;
    for (const Compared& what : compared) {
        std::map<std::string, PlotLine> lines;
        for (std::size_t i = 0; i < sessions.size(); ++i) {
            const auto value = value_of(sessions[i], what);
            if (!value) continue;
            const std::string name =
                names_cases ? sessions[i].trainee + ", " + sessions[i].case_name : sessions[i].trainee;
            PlotLine& line = lines[name];
            line.name = name;
            line.has_dots = true;
            line.x.push_back(attempts[i]);
            line.y.push_back(*value);
        }
        if (lines.empty()) continue;
        SvgPlot plot{.title = what.text, .x_text = "attempt", .y_text = what.unit};
        for (auto& [name, line] : lines) plot.lines.push_back(std::move(line));
        plot.x_is_count = true;
        plot.y_from_zero = std::string(what.key) != "stroke_smoothness_ldlj";
        curves.push_back({what.key, to_svg(plot)});
    }
    return curves;
}

std::string overview_html(const std::vector<SessionRecord>& sessions,
                          const std::vector<std::string>& skipped) {
    std::vector<std::string> cases;
    for (const SessionRecord& session : sessions)
        if (std::ranges::find(cases, session.case_name) == cases.end()) cases.push_back(session.case_name);
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><meta "
        "http-equiv='Content-Security-Policy' "
        "content=\"default-src 'none'; style-src 'unsafe-inline'\"><title>Osteomill: sessions</title>"
        "<style>{}body{{max-width:1200px}}</style></head><body><h1>{} sessions</h1>",
        page_style, sessions.size());
    for (const std::string& line : skipped)
        html += fmt::format("<p class='wrong'>Left out: {}</p>", html_text(line));
    for (const std::string& name : cases)
        html += fmt::format("<h2>{}</h2>{}", html_text(name), table(sessions, name));
    html += "<h2>Learning curves</h2><p class='about'>Against the trainee's attempt at the same case.</p>";
    for (const LearningCurve& curve : learning_curves(sessions)) html += curve.svg;
    return html +
           "<footer>What each number means: docs/metrics.md. All metrics: "
           "sessions.csv.</footer></body></html>\n";
}

}  // namespace osteomill::study
