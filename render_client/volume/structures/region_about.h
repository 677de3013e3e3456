// The region about a structure that a virtual fixture begins with, for the picture of its border.
#pragma once

#include "common/bone/structure_mask.h"

namespace osteomill {

/// The places within `distance_mm` of the structure, on a grid of their own: as fine as the structure's, or
/// coarser if that would be more than some million voxels. Empty for an empty structure. Allocates.
StructureMask region_about(const StructureMask& structure, double distance_mm);

}  // namespace osteomill
