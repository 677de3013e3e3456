// The voxel bone of a scene: a homogeneous block, for the cutting scene with the slot that the burr has cut
// up to where it is put down.
#pragma once

#include "common/bone/bone.h"
#include "tests/studies/stability/scene/scene_plan.h"

namespace osteomill::study {

inline constexpr double scene_voxel_mm = 0.1;
/// Farther off the truth than this a run has gone astray. The block reaches beyond it.
inline constexpr double astray_mm = 2.0;

Bone scene_bone(const ScenePlan& plan);

}  // namespace osteomill::study
