// Removal of the bone that a sweep of the burr passes through, with a report of the removed voxels.
// Idempotent: the fraction left of a voxel depends only on the nearest approach of the burr
// (voxel_coverage.h), so order and number of steps do not matter, and the bone removed by a step is old minus
// new.
#pragma once

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/scene.h"
#include "simulation/carving/removed_voxels.h"
#include "simulation/carving/sweep.h"
#include "simulation/carving/voxel_coverage.h"

namespace osteomill {

/// Knowledge about the bone that a carve may rely on.
enum class CarveHistory {
    none,           ///< nothing: every voxel of the sweep is visited
    carved_at_from  ///< the same ball has already carved at `from`: only the crescent ahead of it can hold
                    ///< bone
};

struct CarveSettings {
    VoxelCoverage coverage = VoxelCoverage::smoothed;
    InstructionSet instructions = best_instruction_set();
    const UncutTissues* uncut = nullptr;  ///< the tissues to leave alone; null: none
};

/// Carves a sweep given in voxel coordinates (whole numbers are voxel centres, radius in voxels). Hands each
/// voxel that lost something to `removed` and the change of each brick to `changes`, both in a fixed order; a
/// brick may come more than once. Looks only at stored bricks and, if the ball has carved at `from`, only at
/// the crescent between the two positions: not the ball's inside, and nothing behind the plane through `from`
/// across the motion, where the nearest point of the path is `from` itself. Real-time safe.
void carve(Bone& bone, const Sweep& ball, CarveHistory history, const CarveSettings& settings,
           ChangeSink& changes, RemovalSink& removed) noexcept;

/// Reports to `would_go` the voxels that carve() would remove with a ball that has carved at `from`, and
/// leaves the bone unchanged. The sweep must not exceed CrescentRows::longest_step_voxels. Real-time safe.
void preview_carve(Bone& bone, const Sweep& ball, const CarveSettings& settings,
                   RemovalSink& would_go) noexcept;

}  // namespace osteomill
