// Bars that `implicit` promises over the range that a surgeon reaches, and the worst that the map has found
// of each.
#pragma once

#include <string>
#include <vector>

#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

struct Bar {
    std::string what;     ///< with its unit
    double bar = 0.0;     ///< what must not be exceeded
    double worst = 0.0;   ///< NaN: nothing was measured
    std::string where{};  ///< the case that was worst; empty where all are alike

    bool is_met() const { return worst <= bar; }
};

/// A device answers at once or a tick late: beyond that the map shows where `implicit` ends, and promises
/// nothing.
inline constexpr int most_promised_delay_ticks = 1;

/// Over all cases of `implicit` within that delay; empty where the map has none of MapPart::bars. Of cutting
/// on an ideal device: the share that is unstable; over what is stable, rms and mean error of the force; the
/// largest force and jump; and over pairs of cases that differ in the milling rate alone, 100 and 1000 Hz, by
/// how much what was carved differs. Then the share of walls that is unstable, and the largest jump on a real
/// device. Last, over all scenes and devices: what contact solves left over, how often they had to fall back,
/// and how often the safety monitor let go for the energy that the hand got.
std::vector<Bar> implicit_bars(const WholeMap& map);

}  // namespace osteomill::study
