// The burr's own axes: origin at the sphere's centre, +z along the spindle from tip to shank.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// Columns are the burr's x, y, z axes in patient LPS; right-handed, orthonormal. `spindle_axis` is a unit
/// vector. The direction of x is immaterial (the burr turns), but it varies continuously except near a
/// spindle along -z (Duff et al. 2017, Building an Orthonormal Basis, Revisited).
inline glm::dmat3 burr_frame(const glm::dvec3& spindle_axis) {
    const glm::dvec3& n = spindle_axis;
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace osteomill
