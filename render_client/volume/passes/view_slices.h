// Slices through a box, parallel to the picture: the proxy geometry of volume rendering by 3D textures
// (Cabral, Cam, Foran 1994).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

/// Triangles, three corners each, of the planes that cut the box `low` to `high` at whole multiples of
/// `spacing` along `forward` (unit) from the eye, as far as they are in front of it; front to back. All
/// lengths are in the same unit. Throws std::invalid_argument unless the spacing is positive.
std::vector<glm::vec3> view_slices(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& eye,
                                   const glm::dvec3& forward, double spacing);

}  // namespace osteomill
