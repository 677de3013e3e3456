#include "analysis/report/first_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/headlines.h"
#include "analysis/report/metrics_html.h"
#include "analysis/report/motion_metrics.h"
#include "analysis/report/page_style.h"
#include "analysis/report/rating_html.h"
#include "analysis/report/session_metrics.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr std::size_t tile_count = 6;

std::string heading(const SessionTrace& trace) {
    const SessionInfo& session = trace.session;
    std::string html = fmt::format("<h1>{}</h1>", session.trainee.empty()
                                                      ? tr("A session")
                                                      : trf("Session of {}", html_text(session.trainee)));
    std::string about = html_text(tr(session.case_name.empty() ? session.scene_name : session.case_name));
    if (const std::string began = local_time_text(trace.began_unix_ns); !began.empty())
        about += " · " + html_text(began);
    html += fmt::format("<p class='about'>{}</p>", about);
    if (session.plan)
        html += fmt::format("<p class='about'>{}</p>", trf("To be removed: {}, with a margin of {} mm",
                                                           html_text(describe(*session.plan)),
                                                           spoken_number("{:.3g}", session.plan->margin_mm)));
    if (!trace.error.empty())
        html +=
            fmt::format("<p class='wrong'>{}</p>",
                        trf("The recording could not be read to its end; this is of what comes before: {}",
                            html_text(tr_about_file(trace.error))));
    else if (!trace.ends)
        html += fmt::format("<p class='wrong'>{}</p>",
                            tr("The recording ends before the session does; this is of what it holds."));
    return html;
}

/// A protected structure in a box of its own: its title, and how much of it.
struct HarmBox {
    const char* kind;
    std::string title;
    std::string how;
};

/// Whether the spindle turned in some state in which the burr was in the structure. A burr that stands still,
/// as after a fault, harms nothing.
bool was_entered_turning(const SessionTrace& trace, const std::string& name) {
    return std::ranges::any_of(trace.samples, [&](const TraceSample& sample) {
        return sample.spindle_on && std::ranges::any_of(sample.distances, [&](const StructureDistance& now) {
                   return now.touches && trace.session.tissues[now.tissue].name == name;
               });
    });
}

/// Opened: some of it was milled, given back or not.
HarmBox opened(const StructureMetrics& one) {
    std::string how = trf("{} mm³ of it milled", number_text(one.dose_mm3 + one.undone_dose_mm3));
    if (one.undone_dose_mm3 > 0.0)
        how += trf(", {} mm³ given back by undo", number_text(one.undone_dose_mm3));
    return {" failed", trf("Opened: {}", html_text(tissue_words(one.name))), how};
}

/// Entered, and nothing of it is milled: a soft structure has no bone that could be.
HarmBox entered(const StructureMetrics& one, bool by_turning_burr) {
    const std::string name = html_text(tissue_words(one.name));
    const std::string mm3 = number_text(one.entered_mm3);
    return by_turning_burr ? HarmBox{" failed", trf("Entered by the turning burr: {}", name),
                                     trf("{} mm³ of it inside the burr; no bone of it milled", mm3)}
                           : HarmBox{" touched", trf("Touched, nothing cut: {}", name),
                                     trf("{} mm³ of it inside the burr, which stood still", mm3)};
}

/// The harm to protected structures, the worst first, whether or not there are marks: nobody may overlook it.
std::string harm(const SessionTrace& trace, const std::vector<StructureMetrics>& structures) {
    std::vector<HarmBox> of_opened, of_turning, of_touched;
    for (const StructureMetrics& one : structures) {
        if (one.dose_mm3 + one.undone_dose_mm3 > 0.0) {
            of_opened.push_back(opened(one));
        } else if (one.entered_mm3 > 0.0) {
            const bool turning = was_entered_turning(trace, one.name);
            (turning ? of_turning : of_touched).push_back(entered(one, turning));
        }
    }
    std::string html;
    for (const auto* boxes : {&of_opened, &of_turning, &of_touched})
        for (const HarmBox& box : *boxes)
            html += fmt::format("<div class='verdict{}'><b>{}</b>{}</div>", box.kind, box.title, box.how);
    return html;
}

std::string mark_text(const JudgedMark& mark) {
    const std::string bound = shown_value(mark.kind->metric, mark.mark).text();
    return mark.kind->is_least ? trf("at least {}", bound) : trf("at most {}", bound);
}

std::string verdict_box(const char* kind, const std::string& title, const std::string& text) {
    return fmt::format("<div class='verdict{}'>{}{}</div>", kind,
                       title.empty() ? "" : fmt::format("<b>{}</b>", title), text);
}

std::string verdict(const SessionTrace& trace, const std::vector<JudgedMark>& marks) {
    if (trace.session.pass.empty()) return verdict_box("", "", tr("No pass marks are set for this case."));
    if (marks.empty()) return verdict_box("", tr("Not judged"), tr("The recording is not complete."));
    std::string missed;
    for (const JudgedMark& mark : marks)
        if (!mark.is_reached())
            missed += fmt::format(
                "{}{}: {}, {}", missed.empty() ? "" : "; ", tr(headline(mark.kind->metric)->text),
                mark.value ? shown_value(mark.kind->metric, *mark.value).text() : "–", mark_text(mark));
    if (missed.empty())
        return verdict_box(" passed", tr("Passed"), trf("All {} marks are reached.", marks.size()));
    return verdict_box(" failed", tr("Not passed"), missed);
}

/// Value, reference band and pass mark on one line, from zero (or the least of them) to the greatest.
std::string gauge(double value, const std::optional<ValueBand>& band, const JudgedMark* mark) {
    double low = std::min(0.0, value);
    double high = std::max(0.0, value);
    const auto hold = [&](double other) { low = std::min(low, other), high = std::max(high, other); };
    if (band) hold(band->low), hold(band->high);
    if (mark != nullptr) hold(mark->mark);
    const double length = high > low ? 1.06 * (high - low) : 1.0;
    const auto x = [&](double at) { return 4.0 + 232.0 * (at - low) / length; };
    std::string svg =
        "<svg viewBox='0 0 240 14' role='img'><path d='M4 7H236' stroke='#b8c2cb' stroke-width='2'/>";
    if (band)
        svg +=
            fmt::format("<rect x='{:.1f}' y='2' width='{:.1f}' height='10' fill='#56b4e9' opacity='0.55'/>",
                        x(band->low), std::max(2.0, x(band->high) - x(band->low)));
    if (mark != nullptr)
        svg += fmt::format("<path d='M{:.1f} 0v14' stroke='#b00' stroke-width='2' stroke-dasharray='3 2'/>",
                           x(mark->mark));
    return svg + fmt::format("<circle cx='{:.1f}' cy='7' r='4' fill='#222'/></svg>", x(value));
}

/// Even without a mark, a touch is no neutral number.
bool is_harm(std::string_view key, double value) {
    return key == "structure_touches" && value > 0.0;
}

std::string band_text(const char* key, const ValueBand& band, const ReferenceSessions& references) {
    const std::size_t count = references.values.at(key).size();
    const std::string low = shown_value(key, band.low).number;
    const std::string high = shown_value(key, band.high).text();
    return references.are_experts ? trf("experts' middle half ({}): {} to {}", count, low, high)
                                  : trf("others' middle half ({}): {} to {}", count, low, high);
}

std::string tile(const Headline& what, double value, const std::string& words,
                 const std::vector<JudgedMark>& marks, const ReferenceSessions& references) {
    const auto mark = std::ranges::find_if(
        marks, [&](const JudgedMark& judged) { return judged.kind->metric == std::string_view(what.key); });
    const bool is_judged = mark != marks.end();
    std::optional<ValueBand> band;
    if (const auto others = references.values.find(what.key); others != references.values.end())
        band = middle_half(others->second);
    std::string html = fmt::format("<div class='tile {}'><span>{}</span><b>{}</b>{}",
                                   !is_judged           ? is_harm(what.key, value) ? "missed" : ""
                                   : mark->is_reached() ? "reached"
                                                        : "missed",
                                   html_text(tr(what.text)), shown_value(what.key, value).text(), words);
    if (is_judged || band) html += gauge(value, band, is_judged ? &*mark : nullptr);
    if (is_judged)
        html += fmt::format("<span>{} {}</span>", mark->is_reached() ? "✓" : "✗",
                            trf("pass mark: {}", mark_text(*mark)));
    else if (what.better != Better::neither)
        html += fmt::format("<span>{}</span>", tr(text_of(what.better)));
    if (band) html += fmt::format("<span>{}</span>", band_text(what.key, *band, references));
    return html + "</div>";
}

std::string words_of_smoothness(const std::vector<MetricRow>& rows) {
    const auto reaches_per_s = sum_of(rows, "stroke_reaches_per_s");
    if (!reaches_per_s) return {};
    return fmt::format(" LDLJ: {}<span>{}</span>", tr(smoothness_word(*reaches_per_s)),
                       trf("as {} reaches a second", number_text(*reaches_per_s)));
}

/// A touch may be a graze or the structure's end: how much of the structures is milled.
std::string words_of_touches(const std::vector<StructureMetrics>& structures) {
    double milled_mm3 = 0.0;
    for (const StructureMetrics& one : structures) milled_mm3 += one.dose_mm3 + one.undone_dose_mm3;
    if (milled_mm3 <= 0.0) return {};
    return fmt::format("<span>{}</span>", trf("{} mm³ milled", number_text(milled_mm3)));
}

/// The first six headlines of which the session has a value.
std::string tiles(const std::vector<MetricRow>& rows, const std::vector<StructureMetrics>& structures,
                  const std::vector<JudgedMark>& marks, const ReferenceSessions& references) {
    std::string html = "<div class='tiles'>";
    std::size_t count = 0;
    for (const Headline& what : headlines)
        if (const auto value = sum_of(rows, what.key); value && count < tile_count) {
            const std::string_view key(what.key);
            const std::string words = key == "stroke_smoothness_ldlj" ? words_of_smoothness(rows)
                                      : key == "structure_touches"    ? words_of_touches(structures)
                                                                      : "";
            html += tile(what, *value, words, marks, references);
            ++count;
        }
    return html + "</div>";
}

std::string legend(const SessionTrace& trace) {
    std::string html = "<p class='about'>";
    for (const Tissue& tissue : trace.session.tissues) {
        const std::string name = html_text(tissue_words(tissue.name));
        html += fmt::format("<span class='entry'>{}{}</span> ", swatch(tissue),
                            tissue.is_protected ? trf("{} (protected)", name) : name);
    }
    if (trace.session.plan)
        html += fmt::format(
            "<span class='entry'><span class='swatch' style='background:#fff;border:2px solid "
            "#005ac8'></span>{}</span>",
            tr("to be removed"));
    return html + "</p>";
}

}  // namespace

std::string first_page(const SessionTrace& trace, const SessionMetrics& metrics,
                       const std::vector<MetricRow>& rows, const SessionPictures& pictures,
                       const ReferenceSessions& references) {
    const std::vector<JudgedMark> marks = judged_marks(metrics.pass, rows);
    return "<div class='first'>" + heading(trace) + harm(trace, metrics.structures) + verdict(trace, marks) +
           rating_summary(trace, metrics.rating) + tiles(rows, metrics.structures, marks, references) +
           figures(pictures.first, "two") + legend(trace) +
           fmt::format(
               "<div class='comment'>{}</div><div class='signatures'><div>{}</div><div>{}</div>"
               "<div>{}</div></div></div>",
               tr("Comment"), tr("Date"), tr("Teacher"), tr("Trainee"));
}

}  // namespace osteomill
