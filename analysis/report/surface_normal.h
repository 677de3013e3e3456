// Normal of a bone's surface about a burr: away from where bone lies on a sphere round the burr.
//
// Minus the mean direction to bone on the sphere, of 256 directions spread evenly (Fibonacci's lattice): a
// plane's own normal, whatever crater the burr made under itself, and in a hole the direction out of it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"

namespace osteomill {

/// Unit, patient LPS. Nothing where no bone is on the sphere, or as much on every side.
std::optional<glm::dvec3> normal_about(const Bone& bone, const glm::dvec3& centre_mm, double radius_mm);

}  // namespace osteomill
