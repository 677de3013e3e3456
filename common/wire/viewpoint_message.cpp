#include "common/wire/viewpoint_message.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "common/bone/patient_space.h"
#include "common/wire/vec3.h"

namespace osteomill {

namespace {

constexpr double narrowest_deg = 1.0;
constexpr double widest_deg = 170.0;
/// The error that single precision makes in a unit quaternion, with a margin.
constexpr double rounding = 1e-3;

}  // namespace

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
