// A column of vectors: three values a row.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace osteomill::python {

inline void push(std::vector<double>& column, const glm::dvec3& v) {
    column.insert(column.end(), {v.x, v.y, v.z});
}

}  // namespace osteomill::python
