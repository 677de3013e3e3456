// Space that a spherical burr passes through during one step: a capsule, the ball swept along a straight
// line.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// A ball of radius `radius` swept from `from` to `to`. All three in one unit of length, voxels where the
/// bone is carved.
struct Sweep {
    glm::dvec3 from{0.0};
    glm::dvec3 to{0.0};
    double radius = 0.0;
};

/// Closed range of x; empty if first > last.
struct Interval {
    double first = 0.0;
    double last = -1.0;

    bool empty() const { return !(first <= last); }
};

/// The interval of x in which the line {(x, y, z): x free} is inside a ball; empty if it misses.
inline Interval line_through_ball(const glm::dvec3& centre, double radius, double y, double z) {
    const double dy = y - centre.y;
    const double dz = z - centre.z;
    const double half_squared = radius * radius - dy * dy - dz * dz;
    if (half_squared < 0.0) return {};
    const double half = std::sqrt(half_squared);
    return {centre.x - half, centre.x + half};
}

/// Volume of the capsule, in the cube of its unit of length.
inline double volume(const Sweep& sweep) {
    constexpr double pi = 3.14159265358979323846;
    const double r = sweep.radius;
    return pi * r * r * (4.0 / 3.0 * r + glm::length(sweep.to - sweep.from));
}

/// Cuts a sweep in voxel coordinates down to the part near which a grid of `size` voxels has any; false if
/// there is none. Real-time safe.
bool cut_to_grid(Sweep& sweep, const glm::ivec3& size) noexcept;

}  // namespace osteomill
