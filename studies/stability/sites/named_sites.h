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

}  // namespace osteomill::study
