// Vectors, grids and viewpoints in and out of their messages.
#pragma once

#include <glm/vec3.hpp>
#include <variant>

#include "common/bone/grid.h"
#include "common/session/viewpoint.h"
#include "common/wire/frame.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill::v2 {
class Viewpoint;  // of session.pb.h, which takes long to parse
}

namespace osteomill {

inline void write(const glm::dvec3& from, v2::Vec3& to) {
    to.set_x(from.x);
    to.set_y(from.y);
    to.set_z(from.z);
}

inline glm::dvec3 read(const v2::Vec3& from) {
    return {from.x(), from.y(), from.z()};
}

v2::Grid to_message(const Grid& grid);

/// Refuses the same grids as require_valid().
std::variant<Grid, WireError> grid_from(const v2::Grid& message);

v2::Viewpoint to_message(const Viewpoint& viewpoint);

/// Refuses an eye that is no place (patient_space.h), axes that are no rotation, and a field of view outside
/// 1 to 170 degrees.
std::variant<Viewpoint, WireError> viewpoint_from(const v2::Viewpoint& message);

}  // namespace osteomill
