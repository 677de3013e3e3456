// A segment of a scan, resampled onto the bone's grid without the scan's staircase.
//
// The segment (1 in it, 0 outside) is taken as an image, refined by the same cubic B-spline as the scan
// itself, and cut near a half: at the value, at most a half, if it is as large as its voxels are. So between
// the scan's voxels the surface runs smoothly. If its voxels are the grid's own, they are used as they are.
#pragma once

#include "common/bone/structure_mask.h"
#include "imaging/segmentation/segmentation.h"

namespace osteomill {

/// Empty if no voxel of the grid is in the segment. Throws std::invalid_argument for a bad grid.
StructureMask structure_of(const Segmentation& segmentation, const Segment& segment, const Grid& grid);

}  // namespace osteomill
