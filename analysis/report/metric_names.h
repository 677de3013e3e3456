// Names and units of all metrics: in a table of the report, below the heading of their group, and alone, as
// in a rating's conditions. Definitions: docs/metrics.md.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace osteomill {

/// Texts are English; tr() translates them.
struct MetricName {
    const char* key;            ///< "force_mean_n"; with {}: a whole number of millimetres
    const char* unit;           ///< "mm^3"; empty: a count or a ratio
    const char* in_table;       ///< "mean while cutting"; empty: no table has it
    const char* alone = "";     ///< "mean force"; empty: no condition asks for it
    const char* of_thing = "";  ///< in a table by tissue or burr, if it is another than in_table
};

inline constexpr auto metric_names = std::to_array<MetricName>({
    {"time_s", "s", "time", "time"},
    {"idle_s", "s", "idle", "time idle"},
    {"paused_s", "s", "paused", "time paused"},
    {"spindle_s", "s", "spindle on", "time with the spindle on"},
    {"cutting_s", "s", "cutting bone", "time of cutting"},
    {"path_mm", "mm", "path of the hand", "path of the hand"},
    {"smoothness_ldlj", "", "smoothness (LDLJ)", "smoothness of the path"},

    {"strokes", "", "strokes", "strokes"},
    {"strokes_undone", "", "of these undone", "strokes that were undone"},
    {"stroke_duration_mean_s", "s", "mean duration", "mean duration of a stroke"},
    {"stroke_duration_max_s", "s", "longest", "longest stroke"},
    {"stroke_length_mean_mm", "mm", "mean length", "mean length of a stroke"},
    {"stroke_smoothness_ldlj", "", "median smoothness (LDLJ)", "smoothness of strokes"},
    {"stroke_reaches_per_s", "1/s", "as reaches a second", "reaches in strokes"},
    {"stroke_length_variation", "", "variation of their length", "variation of strokes' length"},
    {"stroke_force_variation", "", "variation of their mean force", "variation of strokes' force"},

    {"cutting_speed_mean_mm_per_s", "mm/s", "mean speed while cutting", "mean speed of cutting"},
    {"cutting_speed_p95_mm_per_s", "mm/s", "95th percentile of speed",
     "95th percentile of the speed of cutting"},
    {"depth_max_mm", "mm", "greatest depth", "greatest depth"},
    {"cutting_depth_mean_mm", "mm", "mean depth while cutting", "mean depth of cutting"},
    {"cutting_angle_mean_deg", "deg", "mean angle of spindle to surface", "angle of spindle to surface"},
    {"burr_in_view_share", "", "with the burr in view", "cut with the burr in view"},

    {"removed_mm3", "mm^3", "removed", "bone removed"},
    {"undone_mm3", "mm^3", "milled and undone", "given back by undo"},
    {"undos", "", "times that it was undone", "number of undos"},

    {"peak_force_n", "N", "peak", "peak force"},
    {"force_mean_n", "N", "mean while cutting", "mean force", "mean force"},
    {"force_p95_n", "N", "95th percentile of it", "95th percentile of the force", "95th percentile"},
    {"force_impulse_n_s", "N s", "impulse", "impulse"},

    {"breakthroughs", "", "through a far wall", "number of breakthroughs"},
    {"plunge_mean_mm", "mm", "mean plunge in 100 ms", "mean plunge in 100 ms"},
    {"plunge_max_mm", "mm", "deepest", "deepest plunge in 100 ms"},

    {"elsewhere_cutting_s", "s", "cutting bone",
     "time of cutting further than 3 mm from protected structures"},
    {"elsewhere_force_n", "N", "mean force", "mean force further than 3 mm from protected structures"},
    {"elsewhere_feed_mm_per_s", "mm/s", "mean feed", "mean feed further than 3 mm from protected structures"},

    {"removed_by_burr_mm3", "mm^3", "removed", "removed"},
    {"burr_cutting_s", "s", "cutting bone", "time of cutting"},
    {"burr_force_mean_n", "N", "mean force", "mean force"},
    {"removed_of_tissue_mm3", "mm^3", "removed", "removed"},
    {"force_time_s", "s", "cut for", "time of cutting"},

    {"structure_nearest_mm", "mm", "nearest approach", "nearest approach"},
    {"structure_touches", "", "touches", "touches"},
    {"structure_first_touch_s", "s", "first touch", "time of the first touch"},
    {"structure_touched_s", "s", "touched", "time of touching"},
    {"structure_dose_mm3", "mm^3", "removed", "removed"},
    {"structure_undone_mm3", "mm^3", "milled and undone", "milled and undone"},
    {"structure_entered_mm3", "mm^3", "entered by the burr", "entered by the burr"},

    {"structure_bare_share", "", "bare", "surface laid bare"},
    {"structure_under_0_5_mm_share", "", "under less than 0.5 mm", "surface under less than 0.5 mm"},
    {"structure_under_1_mm_share", "", "under less than 1 mm", "surface under less than 1 mm"},
    {"structure_under_2_mm_share", "", "under less than 2 mm", "surface under less than 2 mm"},

    {"structure_near_{}_mm_cutting_s", "s", "cutting bone", "time of cutting within {} mm"},
    {"structure_near_{}_mm_force_n", "N", "mean force", "mean force within {} mm"},
    {"structure_near_{}_mm_force_ratio", "", "of that elsewhere", "force within {} mm by that elsewhere"},
    {"structure_near_{}_mm_feed_mm_per_s", "mm/s", "mean feed", "mean feed within {} mm"},
    {"structure_near_{}_mm_feed_ratio", "", "of that elsewhere", "feed within {} mm by that elsewhere"},

    {"structure_toward_mm", "mm", "toward it", "way of strokes toward it"},
    {"structure_along_mm", "mm", "along it", "way of strokes along it"},
    {"structure_away_mm", "mm", "away from it", "way of strokes away from it"},
    {"structure_toward_share", "", "share toward it", "share of strokes toward it"},

    {"plan_mm3", "mm^3", "planned", "volume of the plan"},
    {"plan_removed_mm3", "mm^3", "of these removed", "removed of the plan"},
    {"plan_removed_share", "", "removed share", "share of the plan removed"},
    {"plan_outside_mm3", "mm^3", "removed outside", "removed outside the plan"},
    {"plan_margin_mm", "mm", "margin", "margin of the plan"},
    {"plan_excess_mm3", "mm^3", "removed beyond the margin", "removed beyond the margin"},
    {"plan_surface_mean_mm", "mm", "mean surface distance", "mean surface distance"},
    {"plan_surface_p95_mm", "mm", "95th percentile of it", "95th percentile of the surface distance"},
    {"plan_hausdorff_mm", "mm", "largest (Hausdorff)", "largest surface distance"},

    {"region_mm3", "mm^3", "", "bone of the region"},
    {"region_removed_mm3", "mm^3", "", "removed of the region"},
    {"region_removed_share", "", "", "share of the region removed"},

    {"rating_points", "", "points"},
    {"rating_most_points", "", "of"},
    {"rating_share", "", "share of them"},
    {"rating_undecided", "", "items not decided"},
    {"rating_item_points", "", "points"},
    {"passed", "", "passed (1) or not (0)"},
});

/// The digit that stands in a key for {} of its name; empty if there is none.
constexpr std::string_view millimetres_in(std::string_view key) {
    constexpr std::string_view near = "structure_near_";
    return key.starts_with(near) ? key.substr(near.size(), 1) : std::string_view();
}

/// Null for a key that no metric has.
constexpr const MetricName* metric_name(std::string_view key) {
    const std::string_view digit = millimetres_in(key);
    for (const MetricName& one : metric_names) {
        const std::string_view named = one.key;
        const std::size_t at = named.find("{}");
        const bool is_same = at == std::string_view::npos
                                 ? named == key
                                 : !digit.empty() && key.size() + 1 == named.size() &&
                                       key.substr(0, at) == named.substr(0, at) &&
                                       key.substr(at + 1) == named.substr(at + 2);
        if (is_same) return &one;
    }
    return nullptr;
}

}  // namespace osteomill
