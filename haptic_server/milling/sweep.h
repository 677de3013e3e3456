// What a spherical burr passes through during one step: a capsule, the ball swept along a straight line.
#pragma once

#include <algorithm>
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

/// Closed range of x; empty where first > last.
struct Interval {
    double first = 0.0;
    double last = -1.0;

    bool empty() const { return !(first <= last); }
};

/// Where the line {(x, y, z): x free} passes through a ball; empty where it misses.
inline Interval line_through_ball(const glm::dvec3& centre, double radius, double y, double z) {
    const double dy = y - centre.y;
    const double dz = z - centre.z;
    const double half_squared = radius * radius - dy * dy - dz * dz;
    if (half_squared < 0.0) return {};
    const double half = std::sqrt(half_squared);
    return {centre.x - half, centre.x + half};
}

/// Where the line {(x, y, z): x free} passes through a sweep. A capsule is convex, so this is one interval:
/// the union of what the line cuts from both end balls and from the cylinder between them.
inline Interval line_through_sweep(const Sweep& sweep, double y, double z) {
    Interval hit = line_through_ball(sweep.from, sweep.radius, y, z);
    const auto extend = [&hit](const Interval& other) {
        if (other.empty()) return;
        hit =
            hit.empty() ? other : Interval{std::min(hit.first, other.first), std::max(hit.last, other.last)};
    };
    extend(line_through_ball(sweep.to, sweep.radius, y, z));

    const glm::dvec3 along = sweep.to - sweep.from;
    const double length = glm::length(along);
    if (length == 0.0) return hit;
    const glm::dvec3 u = along / length;
    // w(x) = (x - from.x, wy, wz); on the cylinder |w|^2 - (w . u)^2 = radius^2, a quadratic in x - from.x.
    const double wy = y - sweep.from.y;
    const double wz = z - sweep.from.z;
    const double c0 = wy * u.y + wz * u.z;
    const double a = 1.0 - u.x * u.x;
    if (a < 1e-12) return hit;  // the sweep runs along the line: the end balls and what lies between them
    const double b = -u.x * c0;
    const double c = wy * wy + wz * wz - c0 * c0 - sweep.radius * sweep.radius;
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return hit;
    const double root = std::sqrt(discriminant);
    Interval cylinder{(-b - root) / a, (-b + root) / a};
    // Between the end planes: 0 <= u.x t + c0 <= length.
    if (std::abs(u.x) > 1e-12) {
        const double t0 = -c0 / u.x;
        const double t1 = (length - c0) / u.x;
        cylinder.first = std::max(cylinder.first, std::min(t0, t1));
        cylinder.last = std::min(cylinder.last, std::max(t0, t1));
    } else if (c0 < 0.0 || c0 > length) {
        return hit;
    }
    extend({sweep.from.x + cylinder.first, sweep.from.x + cylinder.last});
    return hit;
}

/// Distance of a point from the line along which the ball was swept.
inline double distance_to_path(const Sweep& sweep, const glm::dvec3& point) {
    const glm::dvec3 along = sweep.to - sweep.from;
    const double length_squared = glm::dot(along, along);
    const glm::dvec3 w = point - sweep.from;
    if (length_squared == 0.0) return glm::length(w);
    const double t = std::clamp(glm::dot(w, along) / length_squared, 0.0, 1.0);
    return glm::length(w - t * along);
}

/// Volume of the capsule, in the cube of its unit of length.
inline double volume(const Sweep& sweep) {
    constexpr double pi = 3.14159265358979323846;
    const double r = sweep.radius;
    return pi * r * r * (4.0 / 3.0 * r + glm::length(sweep.to - sweep.from));
}

}  // namespace osteomill
