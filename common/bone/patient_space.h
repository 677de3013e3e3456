// Bounds of positions and directions in patient space, whatever they come from: a file, a peer or an option.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace osteomill {

// Check that a vector holds finite numbers.

inline bool is_finite(const glm::dvec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// No patient and no operating theatre is larger than ten metres, and scanners place the patient within
/// metres of their centre. A larger coordinate is a wrong unit, or an attempt to break the arithmetic.
inline constexpr double farthest_place_mm = 10'000.0;

/// Within farthest_place_mm of the origin; false if one is not a number.
inline bool is_place(const glm::dvec3& position_mm) {
    return glm::length(position_mm) <= farthest_place_mm;
}

/// As far as nine decimals of each component can show.
inline bool is_of_unit_length(double length) {
    return length > 1.0 - 1e-9 && length < 1.0 + 1e-9;
}

/// The vector scaled to unit length; nothing if it has no length, is not finite, or is so long that its
/// digits would be lost. A vector of unit length is returned bit for bit, and so is one written with nine
/// decimals, as in recordings.
inline std::optional<glm::dvec3> unit_direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!(length >= 1e-6 && length <= 1e6)) return std::nullopt;
    return is_of_unit_length(length) ? v : v / length;
}

}  // namespace osteomill
