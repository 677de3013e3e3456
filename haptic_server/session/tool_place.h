// Nearest pose at which a tool can stand when it is wanted at a place of the bone.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "simulation/loop/burr_hull.h"

namespace osteomill {

/// Farther from all bone nobody means to begin.
inline constexpr double farthest_from_bone_mm = 50.0;
/// So far the burr is drawn back along its handpiece, at most, to be clear of bone.
inline constexpr double longest_draw_back_mm = 20.0;
/// What is left between burr and bone then.
inline constexpr double least_gap_mm = 0.5;
/// Out of the deepest hole that there is.
inline constexpr double longest_lift_mm = 100.0;

/// `wanted`, or where the burr is clear of bone when it is drawn back along its handpiece; else one line on
/// why it cannot be there: bone all the way, or none near. `hull`: of the burr with its shank.
std::variant<ToolPose, std::string> clear_place(const Bone& bone, const std::vector<HullBall>& hull,
                                                const ToolPose& wanted);

/// Where the burr is clear of bone when it is drawn back along its handpiece; nothing where it is clear
/// already, or bone is all the way.
std::optional<ToolPose> lifted_out(const Bone& bone, const std::vector<HullBall>& hull, const ToolPose& at);

}  // namespace osteomill
