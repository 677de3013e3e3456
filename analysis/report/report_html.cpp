#include "analysis/report/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/report/html_text.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/session_plots.h"
#include "analysis/report/svg_plot.h"

namespace osteomill {

const char* const page_style = R"(
body{font:15px/1.45 "Helvetica Neue",Arial,sans-serif;color:#222;max-width:1000px;margin:0 auto;padding:24px}
h1{font-size:26px;margin:0 0 2px}h2{font-size:18px;margin:30px 0 8px;border-bottom:2px solid #0072b2;padding-bottom:3px}
p.about{color:#555;margin:2px 0}p.wrong{background:#fdecea;border-left:4px solid #b00;padding:8px 12px}
.cards{display:flex;flex-wrap:wrap;gap:12px;margin:18px 0}
.card{flex:1 1 110px;background:#f3f6f9;border-radius:6px;padding:10px 14px}.card b{display:block;font-size:22px}
.card.bad{background:#fdecea}.card.good{background:#e8f5ee}.card span{color:#555;font-size:13px}
table{border-collapse:collapse;margin:6px 0 12px;width:100%}td,th{padding:3px 10px;text-align:left;border-bottom:1px solid #e6e6e6}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}td.u{color:#777;padding-left:0}th{color:#555;font-weight:600}
.columns{columns:2;column-gap:36px}.columns section{break-inside:avoid}h3{font-size:15px;margin:14px 0 2px}
.pictures{display:grid;grid-template-columns:repeat(3,1fr);gap:12px}figure{margin:0}
figure img{width:100%;border:1px solid #ddd;border-radius:4px}figcaption{font-size:13px;color:#555}
svg{width:100%;height:auto;margin:4px 0}svg .title{font-weight:600}
.swatch{display:inline-block;width:11px;height:11px;border-radius:2px;border:1px solid #999;margin:0 5px 0 14px}
footer{color:#777;font-size:13px;margin-top:30px}
@media print{body{max-width:none;padding:0}h2{break-after:avoid}figure,svg{break-inside:avoid}}
)";

std::string number_text(double value) {
    if (!std::isfinite(value)) return "–";
    const double size = std::abs(value);
    if (size >= 1000.0) return fmt::format("{:.0f}", value);
    if (size >= 100.0) return fmt::format("{:.1f}", value);
    if (size == 0.0 || size == std::round(size)) return fmt::format("{:g}", value);
    if (size >= 0.01) return fmt::format("{:.{}f}", value, size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3);
    return fmt::format("{:.2g}", value);
}

namespace {

std::string unit_html(const std::string& unit) {
    return unit == "mm^3" ? "mm³" : html_text(unit);
}

std::string value_html(const std::optional<double>& value) {
    return value ? number_text(*value) : "–";
}

std::string card(const std::string& kind, const std::string& value, const std::string& text) {
    return fmt::format("<div class='card {}'><b>{}</b><span>{}</span></div>", kind, value, html_text(text));
}

std::string cards(const SessionMetrics& metrics) {
    std::string html = "<div class='cards'>";
    html += card("", fmt::format("{} s", number_text(metrics.motion.time_s)), "time");
    html += card("", fmt::format("{} mm³", number_text(metrics.removal.removed_mm3)), "bone removed");
    if (metrics.plan) {
        html += card("", fmt::format("{:.0f} %", 100.0 * metrics.plan->removed_share), "of the plan removed");
        html += card("", fmt::format("{} mm³", number_text(metrics.plan->excess_mm3)),
                     fmt::format("removed beyond its margin of {:g} mm", metrics.plan->margin_mm));
    }
    html += card("", fmt::format("{} N", number_text(metrics.force.peak_n)), "peak force");
    std::size_t touches = 0;
    for (const StructureMetrics& structure : metrics.structures) touches += structure.touches;
    if (!metrics.structures.empty())
        html += card(touches > 0 ? "bad" : "good", std::to_string(touches),
                     touches == 1 ? "touch of a protected structure" : "touches of protected structures");
    return html + "</div>";
}

/// Metrics of things that there are several of: a line for each, a column a metric.
std::string table_of_several(const std::vector<const MetricRow*>& rows, const SessionInfo& session) {
    std::vector<std::string> names;
    std::vector<const MetricRow*> columns;
    for (const MetricRow* row : rows) {
        if (std::ranges::find(names, row->of) == names.end()) names.push_back(row->of);
        const auto is_same = [&](const MetricRow* column) { return column->key == row->key; };
        if (std::ranges::none_of(columns, is_same)) columns.push_back(row);
    }
    std::string html = "<table><tr><th></th>";
    for (const MetricRow* column : columns)
        html += fmt::format("<th class='n'>{}{}</th>", html_text(column->text),
                            column->unit.empty() ? "" : " (" + unit_html(column->unit) + ")");
    html += "</tr>";
    for (const std::string& name : names) {
        std::string swatch;
        for (const Tissue& tissue : session.tissues)
            if (tissue.name == name)
                swatch = fmt::format(
                    "<span class='swatch' style='margin-left:0;background:#{:02x}{:02x}{:02x}'></span>",
                    tissue.colour_rgb[0], tissue.colour_rgb[1], tissue.colour_rgb[2]);
        html += fmt::format("<tr><td>{}{}</td>", swatch, html_text(name));
        for (const MetricRow* column : columns) {
            const auto found = std::ranges::find_if(
                rows, [&](const MetricRow* row) { return row->key == column->key && row->of == name; });
            html +=
                fmt::format("<td class='n'>{}</td>", found == rows.end() ? "–" : value_html((*found)->value));
        }
        html += "</tr>";
    }
    return html + "</table>";
}

std::string table(const std::vector<const MetricRow*>& rows) {
    std::string html = "<table>";
    for (const MetricRow* row : rows)
        html += fmt::format("<tr><td>{}</td><td class='n'>{}</td><td class='u'>{}</td></tr>",
                            html_text(row->text), value_html(row->value), unit_html(row->unit));
    return html + "</table>";
}

std::string tables(const std::vector<MetricRow>& rows, const SessionInfo& session) {
    std::vector<std::string> groups;
    for (const MetricRow& row : rows)
        if (std::ranges::find(groups, row.group) == groups.end()) groups.push_back(row.group);
    std::string narrow;
    std::string wide;
    for (const std::string& group : groups) {
        std::vector<const MetricRow*> single;
        std::map<std::string, std::vector<const MetricRow*>> several;  // by the first word of the key
        for (const MetricRow& row : rows) {
            if (row.group != group) continue;
            if (row.of.empty())
                single.push_back(&row);
            else
                several[row.key.substr(0, row.key.rfind("_mm3") == std::string::npos ? 5 : row.key.size())]
                    .push_back(&row);
        }
        if (group == "Protected structures") {
            std::vector<const MetricRow*> all;
            for (const MetricRow& row : rows)
                if (row.group == group) all.push_back(&row);
            several = {{group, all}};
        }
        if (!single.empty())
            narrow += fmt::format("<section><h3>{}</h3>{}</section>", html_text(group), table(single));
        for (const auto& [key, of_several] : several)
            if (!of_several.empty())
                wide += fmt::format("<h3>{}</h3>{}",
                                    html_text(key == "removed_of_tissue_mm3" ? "Removed bone by tissue"
                                              : key == "removed_by_burr_mm3" ? "Removed bone by burr"
                                              : key == "force"               ? "Force by tissue"
                                                                             : group),
                                    table_of_several(of_several, session));
    }
    return "<div class='columns'>" + narrow + "</div>" + wide;
}

std::string figures(const std::string& heading, const std::vector<SessionPicture>& pictures) {
    if (pictures.empty()) return {};
    std::string html = fmt::format("<h3>{}</h3><div class='pictures'>", html_text(heading));
    for (const SessionPicture& picture : pictures)
        html += fmt::format("<figure><img alt='{0}' src='{1}'><figcaption>{0}</figcaption></figure>",
                            html_text(picture.title), picture.png_uri);
    return html + "</div>";
}

std::string legend(const SessionInfo& session) {
    if (session.tissues.empty()) return {};
    std::string html = "<p class='about'>";
    for (const Tissue& tissue : session.tissues)
        html += fmt::format("<span class='swatch' style='background:#{:02x}{:02x}{:02x}'></span>{}{}",
                            tissue.colour_rgb[0], tissue.colour_rgb[1], tissue.colour_rgb[2],
                            html_text(tissue.name), tissue.is_protected ? " (protected)" : "");
    return html + "</p>";
}

std::string events(const SessionTrace& trace) {
    if (trace.events.empty()) return {};
    std::string html = "<h2>What was done</h2><table><tr><th class='n'>time (s)</th><th></th><th></th></tr>";
    for (const ControlEvent& event : trace.events)
        html +=
            fmt::format("<tr><td class='n'>{:.1f}</td><td>{}{}</td><td>{}</td></tr>", event.time_s,
                        name_of(event.action), event.is_refused ? ", refused" : "", html_text(event.text));
    return html + "</table>";
}

std::string heading(const SessionTrace& trace) {
    const SessionInfo& session = trace.session;
    const std::string title =
        session.trainee.empty() ? "A session" : "Session of " + html_text(session.trainee);
    std::string html = fmt::format("<h1>{}</h1>", title);
    std::string about = html_text(session.case_name.empty() ? session.scene_name : session.case_name);
    if (const std::string began = began_text(trace.began_unix_ns); !began.empty()) about += " · " + began;
    html += fmt::format("<p class='about'>{}</p>", about);
    if (session.plan)
        html += fmt::format("<p class='about'>To be removed: {}, with a margin of {:g} mm</p>",
                            html_text(describe(*session.plan)), session.plan->margin_mm);
    if (!trace.error.empty())
        html += fmt::format(
            "<p class='wrong'>The recording could not be read to its end; this is of what comes before: "
            "{}</p>",
            html_text(trace.error));
    else if (!trace.ends)
        html += "<p class='wrong'>The recording ends before the session does; this is of what it holds.</p>";
    return html;
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
                        const std::vector<MetricRow>& rows, const SessionPictures& pictures) {
    std::string html =
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>"
        "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'\"><meta name='viewport' content='width=device-width'>";
    html += fmt::format(
        "<title>Osteomill: {}</title><style>{}</style></head><body>",
        html_text(trace.session.trainee.empty() ? trace.session.scene_name : trace.session.trainee),
        page_style);
    html += heading(trace) + cards(metrics);
    html += "<h2>Pictures</h2>" + legend(trace.session);
    html += figures("Before", pictures.before) + figures("After", pictures.after) +
            figures("At the marks, from the handpiece", pictures.marks);
    if (pictures.marks_left_out > 0)
        html += fmt::format("<p class='about'>{} later marks have no picture.</p>", pictures.marks_left_out);
    html += "<h2>Over time</h2>";
    for (const SvgPlot& plot : session_plots(trace)) html += to_svg(plot);
    html += "<h2>Numbers</h2>" + tables(rows, trace.session) + events(trace) + settings(trace.session);
    html += fmt::format(
        "<footer>Osteomill {}, bone {:016x}. What each number means: docs/metrics.md. A simulator for "
        "teaching "
        "and research, no medical device.</footer></body></html>\n",
        html_text(trace.session.server_version), trace.bone_checksum);
    return html;
}

}  // namespace osteomill
