// A rating of a session, item by item: points that it earns if a condition holds. Plain data.
//
// It is a department's scale as data: the checks of a rater on the finished bone, written over the metrics of
// docs/metrics.md (rating_condition.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/plan.h"

namespace osteomill {

struct RatingItem {
    std::string name{};
    double points = 1.0;
    std::string when{};              ///< the condition
    std::string source{};            ///< where item and threshold come from; may be empty
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

}  // namespace osteomill
