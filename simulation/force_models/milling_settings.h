// Settings of the milling model, how it carves and how it sums: --force-model chooses them, and studies vary
// them.
#pragma once

#include "simulation/carving/instruction_set.h"
#include "simulation/carving/voxel_coverage.h"
#include "simulation/cutting_force/binned_force.h"

namespace osteomill {

/// How the force is summed over the bone that a step removed.
enum class ForceSummation {
    voxels,   ///< the mean over the step, directly over voxels (mean_force.h)
    bins,     ///< the same over bins [psi, z], as published (binned_force.h)
    instants  ///< within the tooth period (instantaneous_force.h)
};

/// How a step finds the bone that it removes.
enum class VoxelSearch {
    crescent,  ///< only voxels that two positions of the burr do not share (carve.h)
    full_scan  ///< every voxel of the burr, as published (full_scan.h)
};

struct MillingSettings {
    bool has_edge_forces = true;  ///< false: the published law, whatever the burrs' edge coefficients
    ForceSummation summation = ForceSummation::voxels;
    ChipBins bins{};              ///< of ForceSummation::bins
    int instants_per_tooth = 20;  ///< of ForceSummation::instants
    VoxelCoverage coverage = VoxelCoverage::smoothed;
    VoxelSearch search = VoxelSearch::crescent;
    InstructionSet instructions = best_instruction_set();
};

}  // namespace osteomill
