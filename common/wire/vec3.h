// A vector in and out of its message.
#pragma once

#include <glm/vec3.hpp>

#include "osteomill/v2/bone.pb.h"

namespace osteomill {

inline void write(const glm::dvec3& from, v2::Vec3& to) {
    to.set_x(from.x);
    to.set_y(from.y);
    to.set_z(from.z);
}

inline glm::dvec3 read(const v2::Vec3& from) {
    return {from.x(), from.y(), from.z()};
}

}  // namespace osteomill
