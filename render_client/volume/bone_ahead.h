// The bone before a burr: its distance along the spindle, and the visibility of a place on it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"
#include "common/session/tool_state.h"

namespace osteomill {

/// Limit of the search ahead.
inline constexpr double farthest_ahead_mm = 20.0;

/// From the burr's surface to the bone that its centre would meet along the spindle; 0 if they touch. Nothing
/// if there is no bone within farthest_ahead_mm of the centre.
std::optional<double> bone_ahead_mm(const Bone& bone, const ToolState& tool, double burr_radius_mm);

/// Whether bone lies between an eye and a place on the surface of bone.
bool is_behind_bone(const Bone& bone, const glm::dvec3& eye_mm, const glm::dvec3& place_mm);

}  // namespace osteomill
