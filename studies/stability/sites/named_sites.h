// The named sites of the stability study: breakthrough, edges, corners, thin walls, pilot holes, tunnels,
// entries, borders of tissue, stops of the spindle, reversals. In all the spindle points along +z and bone's
// top is z = 0.
#pragma once

#include <vector>

#include "studies/stability/sites/site.h"

namespace osteomill::study {

/// Each site for one burr. Feeds follow the spindle as a careful hand's do, up to 6 mm/s along the surface
/// and 4 along the spindle, about 1.5 N at most.
std::vector<Site> named_sites(const Burr& burr);

/// A 2 mm burr with a shank at the bottom of a hole that is 0.05 to 0.4 mm wider, tilted there to one side
/// and to the other by 4 to 10 degrees: the shank meets the rim and presses the burr into the wall.
std::vector<Site> tilts_in_holes();

}  // namespace osteomill::study
