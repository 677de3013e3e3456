// The strokes of a session, and which of them were undone.
//
// Undo takes a stroke back slice by slice (common/session/stroke_span.h). A stroke is measured
// from the first touch of the turning burr to the last; motion in air after that does not belong to it.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

struct Stroke {
    double begins_s = 0.0;
    double duration_s = 0.0;  ///< in which the spindle turns
    double length_mm = 0.0;   ///< of the burr's path in that time
    double force_n_s = 0.0;   ///< integral of the force on the hand over it
    std::optional<double> smoothness{};
    /// A slice that took bone.
    struct Slice {
        std::map<std::size_t, std::int64_t> levels_by_burr{};
        /// Which undo or reset of the session gave it back, counted from 0; nothing: it stays milled, or was
        /// redone.
        std::optional<std::size_t> undone_by{};
        bool is_undone() const { return undone_by.has_value(); }
    };
    std::vector<Slice> slices{};

    /// All that it took was given back.
    bool is_undone() const { return !slices.empty() && std::ranges::all_of(slices, &Slice::is_undone); }
};

std::vector<Stroke> strokes_of(const SessionTrace& trace);

struct StrokeMetrics {
    std::size_t strokes = 0;
    std::size_t undone = 0;  ///< of these, at the end
    double mean_duration_s = 0.0;
    double mean_length_mm = 0.0;
    double longest_s = 0.0;
    std::optional<double> median_smoothness{};     ///< of the hand in strokes of half a second and more
    std::optional<double> median_reaches_per_s{};  ///< of the same strokes (motion_metrics.h)
    /// Standard deviation over mean, of the strokes' lengths and mean forces: nearer to 0 is more consistent.
    /// Nothing for fewer than three strokes, or if all are zero.
    std::optional<double> length_variation{};
    std::optional<double> force_variation{};
};

StrokeMetrics stroke_metrics(const std::vector<Stroke>& strokes);

}  // namespace osteomill
