#include "analysis/report/metrics_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "analysis/report/page_style.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

ShownValue shown(const MetricRow& row) {
    ShownValue value = shown_value(row.key, row.value.value_or(0.0), row.unit);
    if (!row.value) value.number = "–";
    return value;
}

std::string table(std::span<const MetricRow> rows) {
    std::string html = table_begin;
    for (const MetricRow& row : rows) {
        const ShownValue value = shown(row);
        html += fmt::format("<tr><td>{}</td><td class='n'>{}</td><td class='u'>{}</td></tr>",
                            html_text(with_decimal_sign(tr_filled(row.text))), value.number,
                            html_text(value.unit));
    }
    return html + table_end;
}

/// A line for each thing, a column a metric.
std::string table_of_several(std::span<const MetricRow> rows, const SessionInfo& session) {
    std::vector<std::string> names;
    std::vector<const MetricRow*> columns;
    for (const MetricRow& row : rows) {
        if (std::ranges::find(names, row.of) == names.end()) names.push_back(row.of);
        const auto is_same = [&](const MetricRow* column) { return column->key == row.key; };
        if (std::ranges::none_of(columns, is_same)) columns.push_back(&row);
    }
    std::string html = fmt::format("{}<tr><th></th>", table_begin);
    for (const MetricRow* column : columns) {
        const std::string unit = shown(*column).unit;
        html += fmt::format("<th class='n'>{}{}</th>", html_text(with_decimal_sign(tr_filled(column->text))),
                            unit.empty() ? "" : " (" + html_text(unit) + ")");
    }
    html += "</tr>";
    for (const std::string& name : names) {
        const auto tissue = std::ranges::find(session.tissues, name, &Tissue::name);
        // A burr has its diameter for a name, if nobody gave it one.
        html += tissue == session.tissues.end()
                    ? fmt::format("<tr><td>{}</td>", html_text(with_decimal_sign(tissue_words(name))))
                    : fmt::format("<tr><td>{}{}</td>", swatch(*tissue), html_text(tissue_words(name)));
        for (const MetricRow* column : columns) {
            const auto found = std::ranges::find_if(
                rows, [&](const MetricRow& row) { return row.key == column->key && row.of == name; });
            html += fmt::format("<td class='n'>{}</td>", found == rows.end() ? "–" : shown(*found).number);
        }
        html += "</tr>";
    }
    return html + table_end;
}

}  // namespace

std::string metric_tables(const std::vector<MetricRow>& rows, const SessionInfo& session) {
    std::string narrow;
    std::string wide;
    for (auto begin = rows.begin(); begin != rows.end();) {
        const auto end =
            std::find_if(begin, rows.end(), [&](const MetricRow& row) { return row.group != begin->group; });
        const std::span<const MetricRow> group(begin, end);
        if (begin->key == "rating_item_points") {  // has a table of its own (rating_html.h)
            begin = end;
            continue;
        }
        const std::string heading = fmt::format("<h3>{}</h3>", html_text(tr_filled(begin->group)));
        if (begin->of.empty())
            narrow += "<section>" + heading + table(group) + "</section>";
        else
            wide += "<section>" + heading + table_of_several(group, session) + "</section>";
        begin = end;
    }
    return "<div class='columns'>" + narrow + "</div>" + wide;
}

std::string swatch(const Tissue& tissue) {
    return fmt::format("<span class='swatch' style='background:#{:02x}{:02x}{:02x}'></span>",
                       tissue.colour_rgb[0], tissue.colour_rgb[1], tissue.colour_rgb[2]);
}

}  // namespace osteomill
