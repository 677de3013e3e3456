#include "analysis/report/session_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace osteomill {

namespace {

/// Rows under one heading.
class Rows {
  public:
    explicit Rows(std::vector<MetricRow>& rows) : rows_(rows) {}
    void begin(std::string group) { group_ = std::move(group); }
    void add(std::string key, std::string text, std::optional<double> value, std::string unit = {},
             std::string of = {}) {
        rows_.push_back({group_, std::move(key), std::move(of), std::move(text), value, std::move(unit)});
    }

  private:
    std::vector<MetricRow>& rows_;
    std::string group_;
};

void add_motion(Rows& rows, const MotionMetrics& motion, const StrokeMetrics& strokes) {
    rows.begin("Time and motion");
    rows.add("time_s", "time", motion.time_s, "s");
    rows.add("idle_s", "idle", motion.idle_s, "s");
    rows.add("paused_s", "paused", motion.paused_s, "s");
    rows.add("spindle_s", "spindle on", motion.spindle_s, "s");
    rows.add("cutting_s", "cutting bone", motion.cutting_s, "s");
    rows.add("path_mm", "path of the hand", motion.path_mm, "mm");
    rows.add("smoothness_ldlj", "smoothness (LDLJ)", motion.smoothness);
    rows.begin("Strokes");
    rows.add("strokes", "strokes", static_cast<double>(strokes.strokes));
    rows.add("strokes_undone", "of these undone", static_cast<double>(strokes.undone));
    rows.add("stroke_duration_mean_s", "mean duration", strokes.mean_duration_s, "s");
    rows.add("stroke_duration_max_s", "longest", strokes.longest_s, "s");
    rows.add("stroke_length_mean_mm", "mean length", strokes.mean_length_mm, "mm");
    rows.add("stroke_smoothness_ldlj", "median smoothness (LDLJ)", strokes.median_smoothness);
    rows.add("stroke_reaches_per_s", "as reaches a second", strokes.median_reaches_per_s, "1/s");
    rows.add("stroke_length_variation", "variation of their length", strokes.length_variation);
    rows.add("stroke_force_variation", "variation of their mean force", strokes.force_variation);
    rows.begin("Cutting");
    rows.add("cutting_speed_mean_mm_per_s", "mean speed while cutting", motion.cutting_speed_mm_per_s,
             "mm/s");
    rows.add("cutting_speed_p95_mm_per_s", "95th percentile of speed", motion.cutting_speed_p95_mm_per_s,
             "mm/s");
    rows.add("depth_max_mm", "greatest depth", motion.depth_mm, "mm");
    rows.add("cutting_depth_mean_mm", "mean depth while cutting", motion.cutting_depth_mm, "mm");
    rows.add("cutting_angle_mean_deg", "mean angle of spindle to surface", motion.cutting_angle_deg, "deg");
    rows.add("burr_in_view_share", "with the burr in view", motion.burr_in_view_share);
}

void add_plunges(Rows& rows, const PlungeMetrics& plunges) {
    rows.begin("Breakthroughs");
    rows.add("breakthroughs", "through a far wall", static_cast<double>(plunges.breakthroughs));
    rows.add("plunge_mean_mm", "mean plunge in 100 ms", plunges.mean_mm, "mm");
    rows.add("plunge_max_mm", "deepest", plunges.most_mm, "mm");
}

void add_removal(Rows& rows, const RemovalMetrics& removal) {
    rows.begin("Removed bone");
    rows.add("removed_mm3", "removed", removal.removed_mm3, "mm^3");
    rows.add("undone_mm3", "milled and undone", removal.undone_mm3, "mm^3");
    rows.add("undos", "times that it was undone", static_cast<double>(removal.undos));
}

void add_burrs(Rows& rows, const SessionMetrics& metrics) {
    rows.begin("What each burr did");
    for (const NamedVolume& burr : metrics.removal.by_burr)
        rows.add("removed_by_burr_mm3", "removed", burr.mm3, "mm^3", burr.name);
    for (const ForceOf& burr : metrics.force.by_burr) {
        rows.add("burr_cutting_s", "cutting bone", burr.time_s, "s", burr.name);
        rows.add("burr_force_mean_n", "mean force", burr.mean_n, "N", burr.name);
    }
}

/// Its peak is over all haptic ticks; a peak over frames would differ.
void add_force(Rows& rows, const ForceMetrics& force) {
    rows.begin("Force on the hand");
    rows.add("peak_force_n", "peak", force.peak_n, "N");
    rows.add("force_mean_n", "mean while cutting", force.cutting.mean_n, "N");
    rows.add("force_p95_n", "95th percentile of it", force.cutting.p95_n, "N");
    rows.add("force_impulse_n_s", "impulse", force.cutting.impulse_n_s, "N s");
}

void add_tissues(Rows& rows, const SessionMetrics& metrics) {
    rows.begin("By tissue");
    for (const NamedVolume& tissue : metrics.removal.by_tissue)
        rows.add("removed_of_tissue_mm3", "removed", tissue.mm3, "mm^3", tissue.name);
    for (const ForceOf& tissue : metrics.force.by_tissue) {
        rows.add("force_time_s", "cut for", tissue.time_s, "s", tissue.name);
        rows.add("force_mean_n", "mean force", tissue.mean_n, "N", tissue.name);
        rows.add("force_p95_n", "95th percentile", tissue.p95_n, "N", tissue.name);
        rows.add("force_impulse_n_s", "impulse", tissue.impulse_n_s, "N s", tissue.name);
    }
}

void add_structures(Rows& rows, const std::vector<StructureMetrics>& structures) {
    rows.begin("Protected structures");
    for (const StructureMetrics& structure : structures) {
        rows.add("structure_nearest_mm", "nearest approach", structure.nearest_mm, "mm", structure.name);
        rows.add("structure_touches", "touches", static_cast<double>(structure.touches), "", structure.name);
        rows.add("structure_first_touch_s", "first touch", structure.first_touch_s, "s", structure.name);
        rows.add("structure_touched_s", "touched", structure.touched_s, "s", structure.name);
        rows.add("structure_dose_mm3", "removed", structure.dose_mm3, "mm^3", structure.name);
        rows.add("structure_undone_mm3", "milled and undone", structure.undone_dose_mm3, "mm^3",
                 structure.name);
        rows.add("structure_entered_mm3", "entered by the burr", structure.entered_mm3, "mm^3",
                 structure.name);
    }
}

std::optional<double> ratio(const std::optional<double>& value, const std::optional<double>& to) {
    return value && to && *to > 0.0 ? std::optional(*value / *to) : std::nullopt;
}

void add_elsewhere(Rows& rows, const ForceAndFeed& elsewhere) {
    rows.begin("Cutting further than 3 mm from protected structures");
    rows.add("elsewhere_cutting_s", "cutting bone", elsewhere.time_s, "s");
    rows.add("elsewhere_force_n", "mean force", elsewhere.force_n, "N");
    rows.add("elsewhere_feed_mm_per_s", "mean feed", elsewhere.feed_mm_per_s, "mm/s");
}

void add_nearness(Rows& rows, const NearnessMetrics& near) {
    const ForceAndFeed& elsewhere = near.elsewhere;
    for (std::size_t k = 0; k < near_mm.size(); ++k) {
        rows.begin(fmt::format("Cutting within {} mm of protected structures", near_mm[k]));
        for (const NearStructure& one : near.structures) {
            const ForceAndFeed& within = one.within[k];
            const auto add = [&](const char* key, const char* text, std::optional<double> value,
                                 const char* unit = "") {
                rows.add(fmt::format("structure_near_{}_mm_{}", near_mm[k], key), text, value, unit,
                         one.name);
            };
            add("cutting_s", "cutting bone", within.time_s, "s");
            add("force_n", "mean force", within.force_n, "N");
            add("force_ratio", "of that elsewhere", ratio(within.force_n, elsewhere.force_n));
            add("feed_mm_per_s", "mean feed", within.feed_mm_per_s, "mm/s");
            add("feed_ratio", "of that elsewhere", ratio(within.feed_mm_per_s, elsewhere.feed_mm_per_s));
        }
    }
    rows.begin("Where strokes lead within 3 mm of protected structures");
    for (const NearStructure& one : near.structures) {
        rows.add("structure_toward_mm", "toward it", one.toward_mm, "mm", one.name);
        rows.add("structure_along_mm", "along it", one.along_mm, "mm", one.name);
        rows.add("structure_away_mm", "away from it", one.away_mm, "mm", one.name);
        rows.add("structure_toward_share", "share toward it", one.toward_share(), "", one.name);
    }
}

void add_exposures(Rows& rows, const std::vector<ExposureMetrics>& exposures) {
    static constexpr std::array<const char*, thin_mm.size()> keys{"0_5", "1", "2"};
    rows.begin("Share of a protected structure's surface that was laid open");
    for (const ExposureMetrics& one : exposures) {
        rows.add("structure_bare_share", "bare", one.bare_share, "", one.name);
        for (std::size_t k = 0; k < thin_mm.size(); ++k)
            rows.add(fmt::format("structure_under_{}_mm_share", keys[k]),
                     fmt::format("under less than {:g} mm", thin_mm[k]), one.thin_share[k], "", one.name);
    }
}

void add_plan(Rows& rows, const PlanMetrics& plan) {
    rows.begin("Against the plan");
    rows.add("plan_mm3", "planned", plan.planned_mm3, "mm^3");
    rows.add("plan_removed_mm3", "of these removed", plan.removed_mm3, "mm^3");
    rows.add("plan_removed_share", "removed share", plan.removed_share);
    rows.add("plan_outside_mm3", "removed outside", plan.outside_mm3, "mm^3");
    rows.add("plan_margin_mm", "margin", plan.margin_mm, "mm");
    rows.add("plan_excess_mm3", "removed beyond the margin", plan.excess_mm3, "mm^3");
    const auto surface = [&](double SurfaceDistance::*value) {
        return plan.surface ? std::optional((*plan.surface).*value) : std::nullopt;
    };
    rows.add("plan_surface_mean_mm", "mean surface distance", surface(&SurfaceDistance::mean_mm), "mm");
    rows.add("plan_surface_p95_mm", "95th percentile of it", surface(&SurfaceDistance::p95_mm), "mm");
    rows.add("plan_hausdorff_mm", "largest (Hausdorff)", surface(&SurfaceDistance::hausdorff_mm), "mm");
}

void add_rating(Rows& rows, const RatingResult& rating) {
    const double most = rating.most_points();
    rows.begin("Rating");
    rows.add("rating_points", "points", rating.points());
    rows.add("rating_most_points", "of", most);
    rows.add("rating_share", "share of them", rating.points() / most);
    rows.add("rating_undecided", "items not decided",
             static_cast<double>(
                 std::ranges::count_if(rating.items, [](const RatedItem& one) { return !one.is_reached; })));
    rows.begin("Rating, item by item");
    for (const RatedItem& one : rating.items)
        rows.add("rating_item_points", "points", one.points(), "", one.item.name);
}

}  // namespace

SessionMetrics session_metrics(const SessionTrace& trace) {
    const std::vector<Stroke> strokes = strokes_of(trace);
    const bool is_whole = trace.ends && trace.error.empty();
    SessionMetrics metrics{.motion = motion_metrics(trace),
                           .strokes = stroke_metrics(strokes),
                           .removal = removal_metrics(trace, strokes),
                           .force = force_metrics(trace),
                           .plunges = plunge_metrics(trace.breakthroughs),
                           .structures = structure_metrics(trace),
                           .near = nearness_metrics(trace),
                           .exposures = exposure_metrics(trace),
                           .plan = plan_metrics(trace),
                           .pass = is_whole ? trace.session.pass : PassMarks{},
                           .rating = {}};
    if (is_whole && !trace.session.rating.empty())
        metrics.rating = rating_result(trace.session.rating, metric_rows(metrics), rated_regions(trace),
                                       trace.session.tissues);
    return metrics;
}

std::vector<MetricRow> metric_rows(const SessionMetrics& metrics) {
    std::vector<MetricRow> all;
    Rows rows(all);
    add_motion(rows, metrics.motion, metrics.strokes);
    add_removal(rows, metrics.removal);
    add_force(rows, metrics.force);
    add_plunges(rows, metrics.plunges);
    if (!metrics.structures.empty()) add_elsewhere(rows, metrics.near.elsewhere);
    add_burrs(rows, metrics);
    add_tissues(rows, metrics);
    add_structures(rows, metrics.structures);
    add_exposures(rows, metrics.exposures);
    add_nearness(rows, metrics.near);
    if (metrics.plan) add_plan(rows, *metrics.plan);
    if (!metrics.rating.items.empty()) add_rating(rows, metrics.rating);
    if (const auto passed = has_passed(judged_marks(metrics.pass, all))) {
        rows.begin("Verdict");
        rows.add("passed", "passed (1) or not (0)", *passed ? 1.0 : 0.0);
    }
    return all;
}

std::optional<double> sum_of(std::span<const MetricRow> rows, std::string_view key) {
    std::optional<double> sum;
    for (const MetricRow& row : rows)
        if (row.key == key && row.value) sum = sum.value_or(0.0) + *row.value;
    return sum;
}

std::vector<JudgedMark> judged_marks(const PassMarks& marks, std::span<const MetricRow> rows) {
    std::vector<JudgedMark> judged;
    for (const PassMarkKind& kind : pass_mark_kinds)
        if (const auto mark = marks.find(kind.metric); mark != marks.end())
            judged.push_back({&kind, mark->second, sum_of(rows, kind.metric)});
    return judged;
}

std::optional<bool> has_passed(std::span<const JudgedMark> marks) {
    if (marks.empty()) return std::nullopt;
    return std::ranges::all_of(marks, &JudgedMark::is_reached);
}

}  // namespace osteomill
