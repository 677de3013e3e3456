// Check for bone in a ball, the present burr or one that is to replace it.
#pragma once

#include "common/bone/bone.h"
#include "simulation/force_models/ball_rows.h"

namespace osteomill {

/// Whether a voxel that is at least half there lies in the ball, all of it. Real-time safe; free air and
/// empty rows of voxels cost little.
bool has_bone_in(const Bone& bone, const Ball& ball) noexcept;

}  // namespace osteomill
