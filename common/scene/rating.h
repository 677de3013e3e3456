// The marks that a session has to reach, and its rating, item by item: points that it earns if a condition
// holds. Plain data.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/plan.h"

namespace osteomill {

/// A rating of a session, item by item: points that it earns if a condition holds. Plain data.
///
/// It is a department's scale as data: the checks of a rater on the finished bone, written over the metrics
/// of docs/metrics.md (rating_condition.h).
struct RatingItem {
    std::string name{};
    double points = 1.0;
    std::string when{};                  ///< the condition
    std::string source{};                ///< where item and threshold come from; may be empty
    std::optional<PlanRegion> region{};  ///< what its condition calls the region

    bool operator==(const RatingItem&) const = default;
};

using Rating = std::vector<RatingItem>;

/// Bounds on ratings in files and recordings.
inline constexpr std::size_t most_rating_items = 100;
inline constexpr std::size_t longest_rating_name = 100;       ///< bytes
inline constexpr std::size_t longest_rating_condition = 500;  ///< bytes
inline constexpr std::size_t longest_rating_source = 300;     ///< bytes
inline constexpr double most_rating_points = 1000.0;          ///< of an item

// Pass marks of a scene: bounds on metrics of a session (docs/metrics.md) within which it passes.

/// A metric for which a mark may be set, and the range of sensible marks.
struct PassMarkKind {
    const char* metric;
    bool is_least;  ///< the mark is the least that passes; else the most
    double low;
    double high;
};

inline constexpr std::array<PassMarkKind, 6> pass_mark_kinds{{{"rating_share", true, 0.0, 1.0},
                                                              {"time_s", false, 1.0, 1e6},
                                                              {"plan_removed_share", true, 0.0, 1.0},
                                                              {"plan_excess_mm3", false, 0.0, 1e6},
                                                              {"structure_touches", false, 0.0, 1e6},
                                                              {"peak_force_n", false, 0.01, 1e3}}};

/// By the metric's key.
using PassMarks = std::map<std::string, double>;

/// Null if no mark can be set for it.
constexpr const PassMarkKind* pass_mark_kind(std::string_view metric) {
    for (const PassMarkKind& kind : pass_mark_kinds)
        if (metric == kind.metric) return &kind;
    return nullptr;
}

}  // namespace osteomill
