// Undo and redo in the milling loop's bone: milled bone is given back, or taken again.
#pragma once

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "simulation/force_models/removal_account.h"

namespace osteomill {

/// Gives the voxels of the change their values in `fractions`, enters the difference into the account and
/// pushes the change as restored. A change that does not fit the bone has no effect. Real-time safe.
void restore_bone(const BrickChange& change, BrickFractions fractions, Bone& bone, RemovalAccount& account,
                  ChangeSink& changes) noexcept;

}  // namespace osteomill
