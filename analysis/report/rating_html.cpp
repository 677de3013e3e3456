#include "analysis/report/rating_html.h"

#include <fmt/format.h>

#include "analysis/report/html_text.h"
#include "analysis/report/page_style.h"

namespace osteomill {

namespace {

constexpr std::size_t most_named = 5;

std::string plural(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Full marks by undoing are no full marks: it stands beside the score.
std::string undone_text(const RatingResult& rating) {
    if (rating.undos == 0) return {};
    return fmt::format(" after {} of {} mm³", plural(rating.undos, "undo"), number_text(rating.undone_mm3));
}

std::string missed_text(const RatingResult& rating) {
    std::string names;
    std::size_t missed = 0;
    for (const RatedItem& one : rating.items)
        if (one.is_reached != true && ++missed <= most_named)
            names += fmt::format("{}{}{}", names.empty() ? "" : "; ", html_text(one.item.name),
                                 one.is_reached ? "" : " (not decided)");
    if (missed > most_named) names += fmt::format("; and {} more", missed - most_named);
    return names.empty() ? "Every item is reached." : "Not reached: " + names;
}

std::string verdict_cells(const RatedItem& one) {
    const std::string points =
        fmt::format("<td class='n'>{} / {}</td>", number_text(one.points()), number_text(one.item.points));
    if (!one.is_reached) return "<td>– not decided</td>" + points;
    return (*one.is_reached ? "<td class='yes'>✓</td>" : "<td class='no'>✗</td>") + points;
}

std::string measured_text(const RatedItem& one) {
    if (!one.why_not.empty()) return html_text("cannot be read: " + one.why_not);
    std::string text;
    for (const AskedValue& asked : one.values)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", html_text(asked.text),
                            asked.value ? number_text(*asked.value) : "not measured");
    return text;
}

}  // namespace

std::string rating_summary(const SessionTrace& trace, const RatingResult& rating) {
    if (trace.session.rating.empty()) return {};
    if (rating.items.empty())
        return "<div class='verdict'><b>Not rated</b>The recording is not complete.</div>";
    return fmt::format("<div class='verdict'><b>{} of {} points</b>{}{}</div>", number_text(rating.points()),
                       number_text(rating.most_points()),
                       rating.undos == 0 ? "" : "<b class='undone'>" + undone_text(rating) + "</b>",
                       missed_text(rating));
}

std::string rating_table(const RatingResult& rating) {
    if (rating.items.empty()) return {};
    std::string html = fmt::format(
        "<h2>Rating</h2><p class='about'>{} of {} points{}. Decided from what the recording holds; hand "
        "position, "
        "grip and other things that a rater sees are no part of it.</p><table><tr><th></th><th "
        "class='n'>points</th><th>item</th><th>reached where</th><th>measured</th></tr>",
        number_text(rating.points()), number_text(rating.most_points()), undone_text(rating));
    for (const RatedItem& one : rating.items)
        html += fmt::format(
            "<tr>{}<td>{}{}</td><td><code>{}</code></td><td>{}</td></tr>", verdict_cells(one),
            html_text(one.item.name),
            one.item.source.empty() ? "" : "<span class='source'>" + html_text(one.item.source) + "</span>",
            html_text(one.item.when), measured_text(one));
    return html + "</table>";
}

}  // namespace osteomill
