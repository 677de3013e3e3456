// Balls about the spindle that together hold a burr's head and its shank: if no bone lies in them, the
// burr may stand.
#pragma once

#include <vector>

#include "common/scene/burr.h"

namespace osteomill {

struct HullBall {
    double height_mm = 0.0;  ///< above the burr's centre, along the spindle
    double radius_mm = 0.0;
};

/// The ball itself for a ball without a shank. For anything else, the balls protrude by up to an eighth of
/// its width. Allocates.
std::vector<HullBall> burr_hull(const Burr& burr);

}  // namespace osteomill
