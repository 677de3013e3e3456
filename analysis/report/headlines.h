// The metrics by which people judge a session and compare several, the weightiest first: a report's tiles, an
// overview's columns and curves. One place says how each is called, shown and read.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace osteomill {

enum class Better { lower, higher, neither };

struct Headline {
    const char* key;  ///< docs/metrics.md; of several structures the sum
    const char* text;
    const char* unit;  ///< as shown
    double scale;      ///< from the metric's own unit to the shown one
    Better better;
    bool is_count;  ///< compared by ranks, not by means
};

inline constexpr std::array<Headline, 12> headlines{
    {{"time_s", "time", "s", 1.0, Better::lower, false},
     {"plan_removed_share", "of the plan removed", "%", 100.0, Better::higher, false},
     {"plan_excess_mm3", "removed beyond the margin", "mm³", 1.0, Better::lower, false},
     {"structure_touches", "touches of protected structures", "", 1.0, Better::lower, true},
     {"peak_force_n", "peak force", "N", 1.0, Better::lower, false},
     {"stroke_smoothness_ldlj", "smoothness of strokes", "", 1.0, Better::higher, false},
     {"removed_mm3", "bone removed", "mm³", 1.0, Better::neither, false},
     {"plan_surface_mean_mm", "mean surface distance", "mm", 1.0, Better::lower, false},
     {"path_mm", "path of the hand", "mm", 1.0, Better::lower, false},
     {"stroke_length_variation", "variation of strokes' length", "", 1.0, Better::lower, false},
     {"cutting_angle_mean_deg", "angle of spindle to surface", "°", 1.0, Better::neither, false},
     {"rating_share", "of the rating's points", "%", 100.0, Better::higher, false}}};

constexpr const Headline* headline(std::string_view key) {
    for (const Headline& one : headlines)
        if (key == one.key) return &one;
    return nullptr;
}

constexpr const char* text_of(Better better) {
    return better == Better::lower ? "lower is better" : better == Better::higher ? "higher is better" : "";
}

}  // namespace osteomill
