// Feeds a sum over removed voxels with a single one.
#pragma once

#include <array>

#include "simulation/carving/removed_voxels.h"
#include "simulation/cutting_force/chip_force.h"

namespace osteomill::testing {

/// `voxel` lost `weighted_fraction` (relative stiffness times the fraction removed).
template <typename Force>
void add_voxel(Force& force, const glm::ivec3& voxel, double weighted_fraction) {
    RemovedVoxels removed;
    removed.base = voxel - 3;
    removed.count = 1;
    removed.x[0] = removed.y[0] = removed.z[0] = 3.0f;
    removed.levels[0] = 1.0f;
    removed.pad();
    std::array<float, RemovedVoxels::lanes> weights{static_cast<float>(weighted_fraction)};
    force.add(removed, weights);
}

}  // namespace osteomill::testing
