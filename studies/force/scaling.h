// Cost of a step as the burr and the bone grow: the crescent beside the full scan. Half-immersed burrs,
// upright, 6 mm/s, 0.1 mm voxels.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/progress.h"

namespace osteomill::study {

struct ScalingRow {
    double at = 0.0;                  ///< burr diameter in mm, or edge of the volume in voxels
    double crescent_100_hz_us = 0.0;  ///< medians
    double crescent_1_khz_us = 0.0;
    double scan_100_hz_us = 0.0;
    double scan_1_khz_us = 0.0;
};

/// Diameters of 1 to 6 mm.
std::vector<ScalingRow> cost_by_diameter(bool quick, const Progress& progress);

/// A 5 mm burr on solid cubes of 128 to `largest_voxels` voxels an edge (1024: 1 GiB of bone, twice that
/// while it is built).
std::vector<ScalingRow> cost_by_volume(int largest_voxels, bool quick, const Progress& progress);

/// Table with a header; the first column bears the name `variable`.
std::string csv_of(const std::vector<ScalingRow>& rows, const std::string& variable);

}  // namespace osteomill::study
