// Force of each voxel that a head other than a ball removed: the law of chip_force.h with the normal of the
// head's outline in the place of the ball's.
//
// Slice by slice along the spindle the law is the same: where the outline's normal has the parts n_r away
// from the spindle and n_z along it (of a ball sin kappa and -cos kappa),
//
//     n = (cos psi n_r, sin psi n_r, n_z)       e_kappa = (-cos psi n_z, -sin psi n_z, n_r)
//
// and an edge is as long as the outline. Normals are those of the surface nearest to the voxel. Edges rub on
// s V / a, with a the advance of the surface towards the voxel along the path: for a straight outline that is
// n . d, and where the outline bends it is that of the face nearest to the voxel at half the step.
#pragma once

#include "simulation/cutting_force/chip_force.h"

namespace osteomill {

/// As chip_forces() and sum_of_chip_forces(), for a step whose `head` is not null. Real-time safe.
void head_forces(const CuttingStep& step, const RemovedVoxels& removed, std::span<const float> weights,
                 ChipForces& out) noexcept;
glm::dvec3 sum_of_head_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              std::span<const float> weights) noexcept;

}  // namespace osteomill
