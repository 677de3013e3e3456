#include "analysis/report/rating_html.h"

#include <fmt/format.h>

#include "analysis/report/condition_text.h"
#include "analysis/report/page_style.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr std::size_t most_named = 5;

/// Full marks by undoing are no full marks: it stands beside the score.
std::string undone_text(const RatingResult& rating) {
    if (rating.undos == 0) return {};
    const std::string mm3 = number_text(rating.undone_mm3);
    return " " + (rating.undos == 1 ? trf("after {} undo of {} mm³", rating.undos, mm3)
                                    : trf("after {} undos of {} mm³", rating.undos, mm3));
}

std::string points_text(const RatingResult& rating) {
    return trf("{} of {} points", number_text(rating.points()), number_text(rating.most_points()));
}

std::string missed_name(const RatedItem& one) {
    const std::string name = html_text(tr(one.item.name));
    return one.is_reached ? name : trf("{} (not decided)", name);
}

std::string missed_text(const RatingResult& rating) {
    std::string names;
    std::size_t missed = 0;
    for (const RatedItem& one : rating.items)
        if (one.is_reached != true && ++missed <= most_named)
            names += fmt::format("{}{}", names.empty() ? "" : "; ", missed_name(one));
    if (missed > most_named) names += trf("; and {} more", missed - most_named);
    return names.empty() ? tr("Every item is reached.") : trf("Not reached: {}", names);
}

std::string verdict_cells(const RatedItem& one) {
    const std::string points =
        fmt::format("<td class='n'>{} / {}</td>", number_text(one.points()), number_text(one.item.points));
    if (!one.is_reached) return fmt::format("<td>– {}</td>", tr("not decided")) + points;
    return (*one.is_reached ? "<td class='yes'>✓</td>" : "<td class='no'>✗</td>") + points;
}

std::string measured_text(const RatedItem& one) {
    if (!one.why_not.empty()) return html_text(trf("cannot be read: {}", one.why_not));
    std::string text;
    for (const AskedValue& asked : one.values)
        text +=
            fmt::format("{}{} = {}", text.empty() ? "" : ", ", html_text(quantity_text(asked.key, asked.of)),
                        asked.value ? quantity_value(asked.key, *asked.value).text() : tr("not measured"));
    return text;
}

}  // namespace

std::string rating_summary(const SessionTrace& trace, const RatingResult& rating) {
    if (trace.session.rating.empty()) return {};
    if (rating.items.empty())
        return fmt::format("<div class='verdict'><b>{}</b>{}</div>", tr("Not rated"),
                           tr("The recording is not complete."));
    return fmt::format("<div class='verdict'><b>{}</b>{}{}</div>", points_text(rating),
                       rating.undos == 0 ? "" : "<b class='undone'>" + undone_text(rating) + "</b>",
                       missed_text(rating));
}

std::string rating_table(const RatingResult& rating) {
    if (rating.items.empty()) return {};
    std::string html = fmt::format(
        "<h2>{}</h2><p class='about'>{}{}. {}</p>{}<tr><th></th><th class='n'>{}</th><th>{}</th>"
        "<th>{}</th><th>{}</th></tr>",
        tr("Rating"), points_text(rating), undone_text(rating),
        tr("Decided from what the recording holds; hand position, grip and other things that a rater sees "
           "are no part of it."),
        table_begin, tr("points"), tr("item"), tr("reached where"), tr("measured"));
    for (const RatedItem& one : rating.items)
        html += fmt::format("<tr>{}<td>{}{}</td><td>{}</td><td>{}</td></tr>", verdict_cells(one),
                            html_text(tr(one.item.name)),
                            one.item.source.empty()
                                ? ""
                                : "<span class='source'>" + html_text(tr(one.item.source)) + "</span>",
                            html_text(condition_text(one.item.when)), measured_text(one));
    return html + table_end;
}

}  // namespace osteomill
