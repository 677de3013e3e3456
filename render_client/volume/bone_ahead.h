// The bone before a burr: how far along its spindle, and whether a place on it is seen.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"
#include "common/scene/tool_state.h"

namespace osteomill {

/// Bone further ahead is not looked for.
inline constexpr double farthest_ahead_mm = 20.0;

/// From the burr's surface to the bone that its centre would meet along the spindle; 0 where it is there.
/// Nothing where there is none within farthest_ahead_mm of the centre.
std::optional<double> bone_ahead_mm(const Bone& bone, const ToolState& tool, double burr_radius_mm);

/// Whether bone lies between an eye and a place on the surface of bone.
bool is_behind_bone(const Bone& bone, const glm::dvec3& eye_mm, const glm::dvec3& place_mm);

}  // namespace osteomill
