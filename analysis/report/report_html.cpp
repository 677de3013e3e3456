#include "analysis/report/report_html.h"

#include <fmt/format.h>

#include "analysis/report/first_page.h"
#include "analysis/report/html_text.h"
#include "analysis/report/metric_tables.h"
#include "analysis/report/page_style.h"
#include "analysis/report/rating_html.h"
#include "analysis/report/session_plots.h"

namespace osteomill {

namespace {

std::string pictures_of(const SessionPictures& pictures) {
    std::string html;
    const auto add = [&](const char* heading, const std::vector<ReportPicture>& some) {
        if (!some.empty()) html += fmt::format("<h3>{}</h3>{}", heading, figures(some));
    };
    add("Before", pictures.before);
    add("After", pictures.after);
    add("At the marks, from the handpiece", pictures.marks);
    if (pictures.marks_left_out > 0)
        html += fmt::format("<p class='about'>{} later marks have no picture.</p>", pictures.marks_left_out);
    return html;
}

/// Numbered as over the plots.
std::string events(const SessionTrace& trace) {
    if (trace.events.empty()) return {};
    std::string html =
        "<h2>What was done</h2><table><tr><th class='n'></th><th class='n'>time "
        "(s)</th><th></th><th></th></tr>";
    std::size_t number = 0;
    for (const ControlEvent& event : trace.events)
        html += fmt::format("<tr><td class='n'>{}</td><td class='n'>{:.1f}</td><td>{}{}</td><td>{}</td></tr>",
                            ++number, event.time_s, name_of(event.action),
                            event.is_refused ? ", refused" : "", html_text(event.text));
    return html + "</table>";
}

std::string settings(const SessionInfo& session) {
    if (session.settings.empty()) return {};
    std::string html = "<h2>Settings</h2><table>";
    for (const auto& [name, value] : session.settings)
        html += fmt::format("<tr><td>{}</td><td>{}</td></tr>", html_text(name), html_text(value));
    return html + "</table>";
}

}  // namespace

std::string report_html(const SessionTrace& trace, const SessionMetrics& metrics,
                        const std::vector<MetricRow>& rows, const SessionPictures& pictures,
                        const ReferenceSessions& references) {
    std::string html =
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>"
        "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'\"><meta name='viewport' content='width=device-width'>";
    html += fmt::format(
        "<title>Osteomill: {}</title><style>{}</style></head><body>",
        html_text(trace.session.trainee.empty() ? trace.session.scene_name : trace.session.trainee),
        page_style);
    html += first_page(trace, metrics, rows, pictures, references);
    html += rating_table(metrics.rating);
    html += "<h2>Numbers</h2>" + metric_tables(rows, trace.session);
    html += "<h2>Over time</h2>";
    for (const SvgPlot& plot : session_plots(trace)) html += to_svg(plot);
    html += events(trace) + "<h2>Pictures</h2>" + pictures_of(pictures) + settings(trace.session);
    html += fmt::format(
        "<footer>Osteomill {}, bone {:016x}. What each number means: docs/metrics.md. A simulator for "
        "teaching and research, no medical device.</footer></body></html>\n",
        html_text(trace.session.server_version), trace.bone_checksum);
    return html;
}

}  // namespace osteomill
