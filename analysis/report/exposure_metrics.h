// How much of each protected structure's surface lies bare, or under thin bone, where bone was removed.
//
// The surface are the structure's voxels that share a face with a voxel that is not of it. What is over such
// a voxel is the straight distance from it to the nearest voxel of the cavity (cavity.h), from face to face:
// the distance of their centres less one voxel. It counts where this way leads out of the structure within
// two voxels, not through it: on its far side nothing was exposed. Air that was there before counts neither
// as bone nor as an opening. A voxel of the surface that is cavity itself is bare.
//
// Shares are of area. A voxel's is that of its faces as a slanted surface has it: the square root of the
// number of axes along which it has one, in faces; 8 % too large at worst, where the surface leans by 27
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
    double bare_share = 0.0;                          ///< that nothing is over any more
    std::array<double, thin_mm.size()> thin_share{};  ///< over which there is less than thin_mm
};

/// Of each structure that is somewhere, as the scene lists them, at the end of the session.
std::vector<ExposureMetrics> exposure_metrics(const SessionTrace& trace);

}  // namespace osteomill
