#include "common/wire/geometry_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <stdexcept>

#include "common/bone/patient_space.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

namespace {

constexpr double narrowest_deg = 1.0;
constexpr double widest_deg = 170.0;
/// The error that single precision makes in a unit quaternion, with a margin.
constexpr double rounding = 1e-3;

}  // namespace

v2::Grid to_message(const Grid& grid) {
    v2::Grid message;
    message.set_size_x(static_cast<std::uint32_t>(grid.size_voxels.x));
    message.set_size_y(static_cast<std::uint32_t>(grid.size_voxels.y));
    message.set_size_z(static_cast<std::uint32_t>(grid.size_voxels.z));
    message.set_spacing_mm(grid.spacing_mm);
    write(grid.origin_mm, *message.mutable_origin_mm());
    return message;
}

std::variant<Grid, WireError> grid_from(const v2::Grid& message) {
    constexpr auto largest = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
    if (std::max({message.size_x(), message.size_y(), message.size_z()}) > largest)
        return WireError{"the grid has more than 65536 voxels along an axis"};
    const Grid grid{.size_voxels = {static_cast<int>(message.size_x()), static_cast<int>(message.size_y()),
                                    static_cast<int>(message.size_z())},
                    .spacing_mm = message.spacing_mm(),
                    .origin_mm = read(message.origin_mm())};
    try {
        require_valid(grid);
    } catch (const std::invalid_argument& error) {
        return WireError{error.what()};
    }
    return grid;
}

v2::Viewpoint to_message(const Viewpoint& viewpoint) {
    v2::Viewpoint message;
    write(viewpoint.eye_mm, *message.mutable_eye_mm());
    message.set_qx(static_cast<float>(viewpoint.rotation.x));
    message.set_qy(static_cast<float>(viewpoint.rotation.y));
    message.set_qz(static_cast<float>(viewpoint.rotation.z));
    message.set_qw(static_cast<float>(viewpoint.rotation.w));
    message.set_field_of_view_deg(static_cast<float>(glm::degrees(viewpoint.field_of_view_rad)));
    return message;
}

std::variant<Viewpoint, WireError> viewpoint_from(const v2::Viewpoint& message) {
    const glm::dvec3 eye_mm = read(message.eye_mm());
    if (!is_place(eye_mm)) return WireError{"the eye of a viewpoint is no place within 10 m"};
    const glm::dquat rotation(message.qw(), message.qx(), message.qy(), message.qz());
    if (!(std::abs(glm::length(rotation) - 1.0) <= rounding))
        return WireError{"the axes of a viewpoint are no rotation: their quaternion is not of length 1"};
    const double angle_deg = message.field_of_view_deg();
    if (!(angle_deg >= narrowest_deg && angle_deg <= widest_deg))
        return WireError{fmt::format("a viewpoint's field of view is {} degrees, not {} to {}", angle_deg,
                                     narrowest_deg, widest_deg)};
    return Viewpoint{eye_mm, glm::normalize(rotation), glm::radians(angle_deg)};
}

}  // namespace osteomill
