// Cutting near each protected structure, compared with the same trainee elsewhere: force, feed, and where the
// strokes lead. structure_metrics.h: whether it was touched.
//
// The distance from the burr's head to the structure (structure_watch.h) decides what is near, state by
// state; elsewhere is further than 3 mm from every protected structure. A stroke's path within the 3 mm is
// divided into pieces: consecutive frames that cut, until the burr is 0.5 mm from where the piece began. A
// shorter remainder is left out. A piece leads toward the structure if the distance falls by more than cos 45
// degrees of the piece's length, away if it rises by as much, else along.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

inline constexpr std::array<int, 3> near_mm{1, 2, 3};

/// While bone was cut.
struct ForceAndFeed {
    double time_s = 0.0;
    std::optional<double> force_n{};        ///< mean over time; nothing: no time
    std::optional<double> feed_mm_per_s{};  ///< path of the burr over time
};

struct NearStructure {
    std::string name;
    std::array<ForceAndFeed, near_mm.size()> within{};  ///< near_mm; the wider hold the narrower
    double toward_mm = 0.0;                             ///< length of the pieces
    double along_mm = 0.0;
    double away_mm = 0.0;

    /// A share of all pieces; nothing if there are none.
    std::optional<double> toward_share() const;
};

struct NearnessMetrics {
    ForceAndFeed elsewhere{};
    std::vector<NearStructure> structures{};  ///< near which bone was cut; as the scene lists them
};

NearnessMetrics nearness_metrics(const SessionTrace& trace);

}  // namespace osteomill
