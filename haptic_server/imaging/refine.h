// From a scan's lattice to the bone's: isotropic, fine, along patient LPS.
#pragma once

#include "haptic_server/imaging/hu_volume.h"
#include "haptic_server/imaging/progress.h"
#include "haptic_server/imaging/source_image.h"

namespace osteomill {

/// Voxels of the scan around a region that its spline still feels: coefficients fade by 0.27 a voxel, so
/// eight leave 3e-5.
inline constexpr int refine_margin_voxels = 8;

/// Samples `part` (as `cut` leaves it) at the centres of the grid's voxels by its cubic B-spline, smoothed
/// first along axes where the grid is coarser. Results are clamped to the range of the part's own values: a
/// spline overshoots beside steep edges, and HU that no voxel had would be bone that is not there. Outside
/// the part (corners of a turned scan) there is air. Rounded to whole HU. Uses all cores.
HuVolume refine(SourceImage part, const Grid& grid, const ReportProgress& report);

}  // namespace osteomill
