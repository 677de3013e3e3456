// The voxel bone of a scene: a homogeneous block, for the cutting scene with the slot that the burr has cut
// up to where it is put down.
#pragma once

#include "common/bone/bone.h"
#include "studies/stability/map/scene_plan.h"

namespace osteomill::study {

inline constexpr double scene_voxel_mm = 0.1;
/// Farther off the truth than this a run has gone astray. The block reaches beyond it.
inline constexpr double astray_mm = 2.0;

/// `has_encoders`: the slot is cut, too, where an arm's encoders read the start, up to half a step deeper: a
/// burr that starts inside the bone is without force.
Bone scene_bone(const ScenePlan& plan, bool has_encoders);

}  // namespace osteomill::study
