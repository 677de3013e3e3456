// Check that a vector holds finite numbers.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace osteomill {

inline bool is_finite(const glm::dvec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace osteomill
