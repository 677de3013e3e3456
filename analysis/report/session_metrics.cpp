#include "analysis/report/session_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/report/metric_names.h"

namespace osteomill {

namespace {

/// Rows under one heading.
class Rows {
  public:
    explicit Rows(std::vector<MetricRow>& rows) : rows_(rows) {}
    void begin(std::string group) { group_ = std::move(group); }
    /// Text and unit are those of metric_names.
    void add(std::string key, std::optional<double> value) {
        const MetricName& name = *metric_name(key);
        rows_.push_back({group_, std::move(key), {}, name.in_table, value, name.unit});
    }
    /// The metric of a tissue, a burr or a structure.
    void add(std::string key, std::optional<double> value, std::string of) {
        const MetricName& name = *metric_name(key);
        const char* const text = *name.of_thing != '\0' ? name.of_thing : name.in_table;
        rows_.push_back({group_, std::move(key), std::move(of), text, value, name.unit});
    }

  private:
    std::vector<MetricRow>& rows_;
    std::string group_;
};

void add_motion(Rows& rows, const MotionMetrics& motion, const StrokeMetrics& strokes) {
    rows.begin("Time and motion");
    rows.add("time_s", motion.time_s);
    rows.add("idle_s", motion.idle_s);
    rows.add("paused_s", motion.paused_s);
    rows.add("spindle_s", motion.spindle_s);
    rows.add("cutting_s", motion.cutting_s);
    rows.add("path_mm", motion.path_mm);
    rows.add("smoothness_ldlj", motion.smoothness);
    rows.begin("Strokes");
    rows.add("strokes", static_cast<double>(strokes.strokes));
    rows.add("strokes_undone", static_cast<double>(strokes.undone));
    rows.add("stroke_duration_mean_s", strokes.mean_duration_s);
    rows.add("stroke_duration_max_s", strokes.longest_s);
    rows.add("stroke_length_mean_mm", strokes.mean_length_mm);
    rows.add("stroke_smoothness_ldlj", strokes.median_smoothness);
    rows.add("stroke_reaches_per_s", strokes.median_reaches_per_s);
    rows.add("stroke_length_variation", strokes.length_variation);
    rows.add("stroke_force_variation", strokes.force_variation);
    rows.begin("Cutting");
    rows.add("cutting_speed_mean_mm_per_s", motion.cutting_speed_mm_per_s);
    rows.add("cutting_speed_p95_mm_per_s", motion.cutting_speed_p95_mm_per_s);
    rows.add("depth_max_mm", motion.depth_mm);
    rows.add("cutting_depth_mean_mm", motion.cutting_depth_mm);
    rows.add("cutting_angle_mean_deg", motion.cutting_angle_deg);
    rows.add("burr_in_view_share", motion.burr_in_view_share);
}

void add_plunges(Rows& rows, const PlungeMetrics& plunges) {
    rows.begin("Breakthroughs");
    rows.add("breakthroughs", static_cast<double>(plunges.breakthroughs));
    rows.add("plunge_mean_mm", plunges.mean_mm);
    rows.add("plunge_max_mm", plunges.most_mm);
}

void add_removal(Rows& rows, const RemovalMetrics& removal) {
    rows.begin("Removed bone");
    rows.add("removed_mm3", removal.removed_mm3);
    rows.add("undone_mm3", removal.undone_mm3);
    rows.add("undos", static_cast<double>(removal.undos));
}

void add_burrs(Rows& rows, const SessionMetrics& metrics) {
    rows.begin("What each burr did");
    for (const NamedVolume& burr : metrics.removal.by_burr)
        rows.add("removed_by_burr_mm3", burr.mm3, burr.name);
    for (const ForceOf& burr : metrics.force.by_burr) {
        rows.add("burr_cutting_s", burr.time_s, burr.name);
        rows.add("burr_force_mean_n", burr.mean_n, burr.name);
    }
}

/// Its peak is over all haptic ticks; a peak over frames would differ.
void add_force(Rows& rows, const ForceMetrics& force) {
    rows.begin("Force on the hand");
    rows.add("peak_force_n", force.peak_n);
    rows.add("force_mean_n", force.cutting.mean_n);
    rows.add("force_p95_n", force.cutting.p95_n);
    rows.add("force_impulse_n_s", force.cutting.impulse_n_s);
}

void add_tissues(Rows& rows, const SessionMetrics& metrics) {
    rows.begin("By tissue");
    for (const NamedVolume& tissue : metrics.removal.by_tissue)
        rows.add("removed_of_tissue_mm3", tissue.mm3, tissue.name);
    for (const ForceOf& tissue : metrics.force.by_tissue) {
        rows.add("force_time_s", tissue.time_s, tissue.name);
        rows.add("force_mean_n", tissue.mean_n, tissue.name);
        rows.add("force_p95_n", tissue.p95_n, tissue.name);
        rows.add("force_impulse_n_s", tissue.impulse_n_s, tissue.name);
    }
}

void add_structures(Rows& rows, const std::vector<StructureMetrics>& structures) {
    rows.begin("Protected structures");
    for (const StructureMetrics& structure : structures) {
        rows.add("structure_nearest_mm", structure.nearest_mm, structure.name);
        rows.add("structure_touches", static_cast<double>(structure.touches), structure.name);
        rows.add("structure_first_touch_s", structure.first_touch_s, structure.name);
        rows.add("structure_touched_s", structure.touched_s, structure.name);
        rows.add("structure_dose_mm3", structure.dose_mm3, structure.name);
        rows.add("structure_undone_mm3", structure.undone_dose_mm3, structure.name);
        rows.add("structure_entered_mm3", structure.entered_mm3, structure.name);
    }
}

std::optional<double> ratio(const std::optional<double>& value, const std::optional<double>& to) {
    return value && to && *to > 0.0 ? std::optional(*value / *to) : std::nullopt;
}

void add_elsewhere(Rows& rows, const ForceAndFeed& elsewhere) {
    rows.begin("Cutting further than 3 mm from protected structures");
    rows.add("elsewhere_cutting_s", elsewhere.time_s);
    rows.add("elsewhere_force_n", elsewhere.force_n);
    rows.add("elsewhere_feed_mm_per_s", elsewhere.feed_mm_per_s);
}

void add_nearness(Rows& rows, const NearnessMetrics& near) {
    const ForceAndFeed& elsewhere = near.elsewhere;
    for (std::size_t k = 0; k < near_mm.size(); ++k) {
        rows.begin(fmt::format("Cutting within {} mm of protected structures", near_mm[k]));
        for (const NearStructure& one : near.structures) {
            const ForceAndFeed& within = one.within[k];
            const auto add = [&](const char* key, std::optional<double> value) {
                rows.add(fmt::format("structure_near_{}_mm_{}", near_mm[k], key), value, one.name);
            };
            add("cutting_s", within.time_s);
            add("force_n", within.force_n);
            add("force_ratio", ratio(within.force_n, elsewhere.force_n));
            add("feed_mm_per_s", within.feed_mm_per_s);
            add("feed_ratio", ratio(within.feed_mm_per_s, elsewhere.feed_mm_per_s));
        }
    }
    rows.begin("Where strokes lead within 3 mm of protected structures");
    for (const NearStructure& one : near.structures) {
        rows.add("structure_toward_mm", one.toward_mm, one.name);
        rows.add("structure_along_mm", one.along_mm, one.name);
        rows.add("structure_away_mm", one.away_mm, one.name);
        rows.add("structure_toward_share", one.toward_share(), one.name);
    }
}

void add_exposures(Rows& rows, const std::vector<ExposureMetrics>& exposures) {
    static constexpr std::array<const char*, thin_mm.size()> keys{"0_5", "1", "2"};
    rows.begin("Share of a protected structure's surface that was laid open");
    for (const ExposureMetrics& one : exposures) {
        rows.add("structure_bare_share", one.bare_share, one.name);
        for (std::size_t k = 0; k < thin_mm.size(); ++k)
            rows.add(fmt::format("structure_under_{}_mm_share", keys[k]), one.thin_share[k], one.name);
    }
}

void add_plan(Rows& rows, const PlanMetrics& plan) {
    rows.begin("Against the plan");
    rows.add("plan_mm3", plan.planned_mm3);
    rows.add("plan_removed_mm3", plan.removed_mm3);
    rows.add("plan_removed_share", plan.removed_share);
    rows.add("plan_outside_mm3", plan.outside_mm3);
    rows.add("plan_margin_mm", plan.margin_mm);
    rows.add("plan_excess_mm3", plan.excess_mm3);
    const auto surface = [&](double SurfaceDistance::*value) {
        return plan.surface ? std::optional((*plan.surface).*value) : std::nullopt;
    };
    rows.add("plan_surface_mean_mm", surface(&SurfaceDistance::mean_mm));
    rows.add("plan_surface_p95_mm", surface(&SurfaceDistance::p95_mm));
    rows.add("plan_hausdorff_mm", surface(&SurfaceDistance::hausdorff_mm));
}

void add_rating(Rows& rows, const RatingResult& rating) {
    const double most = rating.most_points();
    rows.begin("Rating");
    rows.add("rating_points", rating.points());
    rows.add("rating_most_points", most);
    rows.add("rating_share", rating.points() / most);
    rows.add("rating_undecided", static_cast<double>(std::ranges::count_if(
                                     rating.items, [](const RatedItem& one) { return !one.is_reached; })));
    rows.begin("Rating, item by item");
    for (const RatedItem& one : rating.items) rows.add("rating_item_points", one.points(), one.item.name);
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
        rows.add("passed", *passed ? 1.0 : 0.0);
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
