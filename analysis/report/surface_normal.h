// Normal of a bone's surface at a burr: it points away from the bone on a sphere round the burr.
//
// It is minus the mean of those of 256 evenly spread directions (Fibonacci's lattice) that meet bone on the
// sphere. At a plane it is the plane's own normal, whatever crater the burr made under itself; in a hole it
// leads out.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"

namespace osteomill {

/// Unit, patient LPS. Nothing if the sphere meets no bone, or as much on every side.
std::optional<glm::dvec3> normal_about(const Bone& bone, const glm::dvec3& centre_mm, double radius_mm);

}  // namespace osteomill
