// Signed distances, mm, negative inside, of the simple bodies that phantoms are put together from. Only + - *
// / and square roots, so that every compiler and optimisation gives the same bits.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace osteomill::distance_field {

inline double squared(double a) {
    return a * a;
}

/// 1 at t = 0, falling smoothly to 0 at t = 1; t is a squared distance over a squared radius.
inline double bump(double t) {
    return squared(std::max(0.0, 1.0 - t));
}

/// A box of half extents `half_mm` around the origin, its edges rounded with `rounding_mm`.
inline double rounded_box(const glm::dvec3& p, const glm::dvec3& half_mm, double rounding_mm) {
    const glm::dvec3 q = glm::abs(p) - half_mm + rounding_mm;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, std::max(q.y, q.z)), 0.0) - rounding_mm;
}

/// An ellipsoid around the origin; exact on the surface, near it to first order.
inline double ellipsoid(const glm::dvec3& p, const glm::dvec3& radii_mm) {
    const double k0 = glm::length(p / radii_mm);
    const double k1 = glm::length(p / (radii_mm * radii_mm));
    return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min(radii_mm.x, std::min(radii_mm.y, radii_mm.z));
}

/// A cone with a round tip: the ball at `from` has radius `from_radius_mm`, the one at `to` `to_radius_mm`.
inline double round_cone(const glm::dvec3& p, const glm::dvec3& from, const glm::dvec3& to,
                         double from_radius_mm, double to_radius_mm) {
    const glm::dvec3 axis = to - from;
    const double t = std::clamp(glm::dot(p - from, axis) / glm::dot(axis, axis), 0.0, 1.0);
    return glm::distance(p, from + t * axis) - (from_radius_mm + t * (to_radius_mm - from_radius_mm));
}

/// Union and intersection with edges blended over `blend_mm`.
inline double smooth_union(double a, double b, double blend_mm) {
    const double h = std::max(blend_mm - std::abs(a - b), 0.0) / blend_mm;
    return std::min(a, b) - 0.25 * h * h * blend_mm;
}
inline double smooth_intersection(double a, double b, double blend_mm) {
    return -smooth_union(-a, -b, blend_mm);
}

}  // namespace osteomill::distance_field
