// Convergence of the error with the size of voxels.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/progress.h"
#include "studies/force/studied_motion.h"

namespace osteomill::study {

struct ConvergenceRow {
    double voxel_mm = 0.0;
    double soft_error =
        0.0;  ///< mean over the motions and over where the lattice lies, share of the reference
    double binary_error = 0.0;
};

struct Convergence {
    std::vector<ConvergenceRow> rows;
    double soft_slope = 0.0;  ///< of log error against log voxel size: 1 is linear
    double binary_slope = 0.0;
};

Convergence measure_convergence(const std::vector<StudiedMotion>& motions, bool quick,
                                const Progress& progress);

/// Table with a header, errors in percent; two last columns hold the fitted power law of each.
std::string csv_of(const Convergence& convergence);

}  // namespace osteomill::study
