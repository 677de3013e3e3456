#include "analysis/report/report_html.h"

#include <fmt/format.h>

#include "analysis/report/first_page.h"
#include "analysis/report/metrics_html.h"
#include "analysis/report/page_style.h"
#include "analysis/report/rating_html.h"
#include "analysis/report/session_plots.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

std::string heading(const char* text) {
    return fmt::format("<h2>{}</h2>", text);
}

std::string pictures_of(const SessionPictures& pictures) {
    std::string html;
    const auto add = [&](const char* title, const std::vector<ReportPicture>& some) {
        if (!some.empty()) html += fmt::format("<h3>{}</h3>{}", title, figures(some));
    };
    add(tr("Before"), pictures.before);
    add(tr("After"), pictures.after);
    add(tr("At the marks, from the handpiece"), pictures.marks);
    if (pictures.marks_left_out > 0)
        html += fmt::format("<p class='about'>{}</p>",
                            trf("{} later marks have no picture.", pictures.marks_left_out));
    return html;
}

/// Numbered as over the plots.
std::string events(const SessionTrace& trace) {
    if (trace.events.empty()) return {};
    std::string html = fmt::format("{}{}<tr><th class='n'></th><th class='n'>{}</th><th></th><th></th></tr>",
                                   heading(tr("What was done")), table_begin, tr("time (s)"));
    std::size_t number = 0;
    for (const ControlEvent& event : trace.events) {
        const char* const action = tr(name_of(event.action));
        const bool is_note = event.action == SessionAction::mark && !event.is_refused;
        html += fmt::format("<tr><td class='n'>{}</td><td class='n'>{}</td><td>{}</td><td>{}</td></tr>",
                            ++number, spoken_number("{:.1f}", event.time_s),
                            event.is_refused ? trf("{}, refused", action) : action,
                            html_text(is_note ? event.text : with_decimal_sign(tr_filled(event.text))));
    }
    return html + table_end;
}

std::string settings(const SessionInfo& session) {
    if (session.settings.empty()) return {};
    std::string html = heading(tr("Settings")) + table_begin;
    for (const auto& [name, value] : session.settings)
        html +=
            fmt::format("<tr><td>{}</td><td class='setting'>{}</td></tr>", html_text(name), html_text(value));
    return html + table_end;
}

}  // namespace

std::string report_html(const SessionTrace& trace, const SessionMetrics& metrics,
                        const std::vector<MetricRow>& rows, const SessionPictures& pictures,
                        const ReferenceSessions& references) {
    std::string html = fmt::format("<!DOCTYPE html>\n<html lang='{}'>", spoken_language());
    html +=
        "<head><meta charset='utf-8'>"
        "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'\"><meta name='viewport' content='width=device-width'>";
    html += fmt::format(
        "<title>Osteomill: {}</title><style>{}</style></head><body>",
        html_text(trace.session.trainee.empty() ? tr(trace.session.scene_name) : trace.session.trainee),
        page_style);
    html += first_page(trace, metrics, rows, pictures, references);
    html += rating_table(metrics.rating);
    html += heading(tr("Numbers")) + metric_tables(rows, trace.session);
    html += heading(tr("Over time"));
    for (const SvgPlot& plot : session_plots(trace)) html += to_svg(plot);
    html += events(trace) + heading(tr("Pictures")) + pictures_of(pictures) + settings(trace.session);
    html += fmt::format(
        "<footer>{}</footer></body></html>\n",
        trf("Osteomill {}, bone {:016x}. What each number means: docs/metrics.md. A simulator for teaching "
            "and research, no medical device.",
            html_text(trace.session.server_version), trace.bone_checksum));
    return html;
}

}  // namespace osteomill
