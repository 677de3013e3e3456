// The quantities that a rating's condition may ask for: metrics of docs/metrics.md by their key, and the
// region's. A test compares the table with the metrics of a session.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace osteomill {

/// Kind of the name that a quantity takes in parentheses.
enum class RatedThing : std::uint8_t {
    session,            ///< none
    plan,               ///< none, of a scene with a [plan]
    region,             ///< none, of an item with a region
    session_or_tissue,  ///< a tissue's; without: of the session
    tissue,             ///< a tissue's
    burr,               ///< a burr's
    structure,          ///< a protected tissue's
    any_structure,      ///< its name is optional; without: of all together
};

struct RatedQuantity {
    const char* key;
    RatedThing of = RatedThing::session;
    bool is_zero_if_absent = false;  ///< where a session has no such value; else that is not known
};

inline constexpr std::array<RatedQuantity, 82> rated_quantities{{
    {"time_s"},
    {"paused_s"},
    {"idle_s"},
    {"spindle_s"},
    {"cutting_s"},
    {"path_mm"},
    {"smoothness_ldlj"},
    {"strokes"},
    {"strokes_undone"},
    {"stroke_duration_mean_s"},
    {"stroke_duration_max_s"},
    {"stroke_length_mean_mm"},
    {"stroke_smoothness_ldlj"},
    {"stroke_reaches_per_s"},
    {"stroke_length_variation"},
    {"stroke_force_variation"},
    {"cutting_speed_mean_mm_per_s"},
    {"cutting_speed_p95_mm_per_s"},
    {"depth_max_mm"},
    {"cutting_depth_mean_mm"},
    {"cutting_angle_mean_deg"},
    {"burr_in_view_share"},
    {"removed_mm3"},
    {"undone_mm3"},
    {"undos"},
    {"peak_force_n"},
    {"force_mean_n", RatedThing::session_or_tissue},
    {"force_p95_n", RatedThing::session_or_tissue},
    {"force_impulse_n_s", RatedThing::session_or_tissue},
    {"force_time_s", RatedThing::tissue, true},
    {"removed_of_tissue_mm3", RatedThing::tissue},
    {"removed_by_burr_mm3", RatedThing::burr, true},
    {"burr_cutting_s", RatedThing::burr, true},
    {"burr_force_mean_n", RatedThing::burr},
    {"breakthroughs"},
    {"plunge_mean_mm"},
    {"plunge_max_mm"},
    {"elsewhere_cutting_s"},
    {"elsewhere_force_n"},
    {"elsewhere_feed_mm_per_s"},
    {"structure_nearest_mm", RatedThing::structure},
    {"structure_touches", RatedThing::any_structure},
    {"structure_first_touch_s", RatedThing::structure},
    {"structure_touched_s", RatedThing::any_structure},
    {"structure_dose_mm3", RatedThing::any_structure},
    {"structure_undone_mm3", RatedThing::any_structure},
    {"structure_entered_mm3", RatedThing::any_structure},
    {"structure_bare_share", RatedThing::structure},
    {"structure_under_0_5_mm_share", RatedThing::structure},
    {"structure_under_1_mm_share", RatedThing::structure},
    {"structure_under_2_mm_share", RatedThing::structure},
    {"structure_near_1_mm_cutting_s", RatedThing::structure, true},
    {"structure_near_1_mm_force_n", RatedThing::structure},
    {"structure_near_1_mm_force_ratio", RatedThing::structure},
    {"structure_near_1_mm_feed_mm_per_s", RatedThing::structure},
    {"structure_near_1_mm_feed_ratio", RatedThing::structure},
    {"structure_near_2_mm_cutting_s", RatedThing::structure, true},
    {"structure_near_2_mm_force_n", RatedThing::structure},
    {"structure_near_2_mm_force_ratio", RatedThing::structure},
    {"structure_near_2_mm_feed_mm_per_s", RatedThing::structure},
    {"structure_near_2_mm_feed_ratio", RatedThing::structure},
    {"structure_near_3_mm_cutting_s", RatedThing::structure, true},
    {"structure_near_3_mm_force_n", RatedThing::structure},
    {"structure_near_3_mm_force_ratio", RatedThing::structure},
    {"structure_near_3_mm_feed_mm_per_s", RatedThing::structure},
    {"structure_near_3_mm_feed_ratio", RatedThing::structure},
    {"structure_toward_mm", RatedThing::any_structure, true},
    {"structure_along_mm", RatedThing::any_structure, true},
    {"structure_away_mm", RatedThing::any_structure, true},
    {"structure_toward_share", RatedThing::structure},
    {"plan_mm3", RatedThing::plan},
    {"plan_removed_mm3", RatedThing::plan},
    {"plan_removed_share", RatedThing::plan},
    {"plan_outside_mm3", RatedThing::plan},
    {"plan_margin_mm", RatedThing::plan},
    {"plan_excess_mm3", RatedThing::plan},
    {"plan_surface_mean_mm", RatedThing::plan},
    {"plan_surface_p95_mm", RatedThing::plan},
    {"plan_hausdorff_mm", RatedThing::plan},
    {"region_mm3", RatedThing::region},
    {"region_removed_mm3", RatedThing::region},
    {"region_removed_share", RatedThing::region},
}};

/// Null if no quantity has that key.
constexpr const RatedQuantity* rated_quantity(std::string_view key) {
    for (const RatedQuantity& one : rated_quantities)
        if (key == one.key) return &one;
    return nullptr;
}

}  // namespace osteomill
