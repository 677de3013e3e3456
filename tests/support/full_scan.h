// The published way to mill, the baseline of speed: the tool is a set of voxels; every step takes every one
// of them, some 65 000 for a 5 mm burr at 0.1 mm, turns it into the burr's frame, tests it against the tool's
// shape and the bone, and lowers what is left. No bricks are passed over, no crescent is known. It follows
// the same rule of what a sweep leaves of a voxel (voxel_coverage.h) and sums force with the same sums
// (binned_force.h, chip_force.h), so that bone and force are those of MillingModel, and only how voxels are
// found differs.
#pragma once

#include "studies/force/studied_model.h"

namespace osteomill::study {

/// `settings.instructions` has no say over the scan, which is plain code; ForceSummation::instants is refused
/// with std::invalid_argument.
MakeModel full_scan_model(const MillingSettings& settings = {});

/// Voxels that a scan of a burr visits while the burr stands still.
std::size_t tool_voxel_count(const Burr& burr, double voxel_mm);

}  // namespace osteomill::study
