// Pass marks of a scene: bounds on metrics of a session (docs/metrics.md) within which it passes.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace osteomill {

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
