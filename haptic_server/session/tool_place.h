// The nearest pose clear of bone for a tool that is to be placed at a point of the bone.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "simulation/loop/clearance.h"

namespace osteomill {

/// A start farther from all bone counts as a mistake.
inline constexpr double farthest_from_bone_mm = 50.0;
/// Greatest distance by which the burr is drawn back along its handpiece to be clear of bone.
inline constexpr double longest_draw_back_mm = 20.0;
/// Gap between burr and bone afterwards.
inline constexpr double least_gap_mm = 0.5;
/// Out of the deepest hole that there is.
inline constexpr double longest_lift_mm = 100.0;

/// `wanted`, or where the burr is clear of bone when it is drawn back along its handpiece; else one line on
/// why it cannot be there: bone all the way, or none near. `hull`: the hull of the burr with its shank.
std::variant<ToolPose, std::string> clear_place(const Bone& bone, const std::vector<HullBall>& hull,
                                                const ToolPose& wanted);

/// The pose at which the burr is clear of bone when it is drawn back along its handpiece; nothing if it is
/// clear already, or bone is all the way.
std::optional<ToolPose> lifted_out(const Bone& bone, const std::vector<HullBall>& hull, const ToolPose& at);

}  // namespace osteomill
