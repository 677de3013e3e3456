// Exposure of each protected structure: the shares of its surface that lie bare, or under thin bone, after
// bone was removed. structure_metrics.h: whether the structure itself was milled, "Opened" in the report.
//
// The surface consists of the structure's voxels that share a face with a voxel outside of it. The bone over
// such a voxel is as thick as the straight distance from it to the nearest voxel of the cavity (voxel_set.h),
// from face to face: the distance of their centres less one voxel. It counts only if this line leaves the
// structure within two voxels; a line through the structure leads to its far side, where nothing was exposed.
// Air that was there before counts neither as bone nor as an opening. A voxel of the surface that is cavity
// itself is bare.
//
// Shares are of area. A voxel's area, in faces, is the square root of the number of axes along which it has a
// free face, as a slanted surface has it; it is 8 % too large at worst, on a surface that leans by 27
// degrees.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

inline constexpr std::array<double, 3> thin_mm{0.5, 1.0, 2.0};

struct ExposureMetrics {
    std::string name;
    double bare_share = 0.0;                          ///< without any bone over it
    std::array<double, thin_mm.size()> thin_share{};  ///< under less than thin_mm of bone
};

/// The exposure of each structure that is somewhere, in the scene's order, at the end of the session.
std::vector<ExposureMetrics> exposure_metrics(const SessionTrace& trace);

}  // namespace osteomill
