// Removal of the bone that a sweep of the burr passes through, with word of what went. Idempotent: what is
// left of a voxel depends on the nearest approach of the burr alone (voxel_coverage.h), so neither order nor
// number of steps matters and what a step removed is old minus new.
#pragma once

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/uncut_tissues.h"
#include "simulation/carving/removed_voxels.h"
#include "simulation/carving/sweep.h"
#include "simulation/carving/voxel_coverage.h"

namespace osteomill {

/// What a carve may take for granted about the bone.
enum class CarveHistory {
    none,           ///< nothing: every voxel of the sweep is looked at
    carved_at_from  ///< the same ball has already carved at `from`: only the crescent ahead of it can hold
                    ///< bone
};

struct CarveSettings {
    VoxelCoverage coverage = VoxelCoverage::smoothed;
    InstructionSet instructions = best_instruction_set();
    const UncutTissues* uncut = nullptr;  ///< what is left alone; null: nothing
};

/// Carves a sweep given in voxel coordinates (whole numbers are voxel centres, radius in voxels). Hands each
/// voxel that lost something to `removed` and the change of each brick to `changes`, both in a fixed order; a
/// brick may come more than once. Looks only at stored bricks and, where the ball has carved at `from`, only
/// at the crescent between the two positions: not the ball's inside, and nothing behind the plane through
/// `from` across the motion, where the nearest point of the path is `from` itself. Real-time safe.
void carve(Bone& bone, const Sweep& ball, CarveHistory history, const CarveSettings& settings,
           ChangeSink& changes, RemovalSink& removed) noexcept;

/// Hands to `would_go` what carve() would remove where the ball has carved at `from`, and leaves the bone as
/// it is. The sweep is no longer than CrescentRows::longest_step_voxels. Real-time safe.
void look_ahead(Bone& bone, const Sweep& ball, const CarveSettings& settings, RemovalSink& would_go) noexcept;

}  // namespace osteomill
