// Result of a rating: which of its items a session reached, and for how many points.
//
// Conditions are decided over the session's metrics (common/scene/rating_condition.h). A structure that the
// burr never came near is further away than watched_mm. Some quantities are zero if the thing was not done at
// all (rating_quantities.h); any other that was not measured is unknown. An item that stays unknown, or that
// this version cannot read, earns nothing and says so.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"
#include "common/scene/rating.h"

namespace osteomill {

struct MetricRow;

/// Bone of an item's region: at the start, and how much of that is gone.
struct RegionVolumes {
    double bone_mm3 = 0.0;
    double removed_mm3 = 0.0;
};

/// Volumes of each item of the session's rating, in its order; nothing: the item has no region.
std::vector<std::optional<RegionVolumes>> rated_regions(const SessionTrace& trace);

/// A quantity that a condition asks for, as people read it: "structure touches of Facial_Nerve".
struct AskedValue {
    std::string text;
    std::string key;
    std::string of{};               ///< which tissue; empty: the session, or all
    std::optional<double> value{};  ///< nothing: not measured
};

struct RatedItem {
    RatingItem item{};
    std::optional<bool> is_reached{};  ///< nothing: unknown
    std::vector<AskedValue> values{};
    std::string why_not{};  ///< its condition cannot be read; empty: it can

    double points() const { return is_reached == true ? item.points : 0.0; }
};

struct RatingResult {
    std::vector<RatedItem> items{};
    std::size_t undos = 0;    ///< beside the score: how often something was undone
    double undone_mm3 = 0.0;  ///< and how much
    double points() const;
    double most_points() const;
};

/// Nothing without items. `rows`: of the session's metrics; `watched`: the distance up to which each
/// protected structure is looked at, by its tissue's name.
RatingResult rating_result(const Rating& rating, std::span<const MetricRow> rows,
                           std::span<const std::optional<RegionVolumes>> regions,
                           std::span<const Tissue> tissues);

}  // namespace osteomill
