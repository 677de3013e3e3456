// Pinhole cameras as computer vision writes them: intrinsics in pixels, and a pose in patient LPS.
//
//     u = fx X / Z + cx,   v = fy Y / Z + cy
//
// X to the right, Y down, Z forward in mm from the camera's centre (Hartley and Zisserman, Multiple View
// Geometry, 2003, section 6.1, without skew). Pixel (u, v) = (0, 0) is the middle of the upper left one, so
// that the middle of a picture is at ((width - 1) / 2, (height - 1) / 2).
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/session/viewpoint.h"
#include "render_client/volume/camera.h"

namespace osteomill {

struct Pinhole {
    glm::ivec2 size_px{640, 480};
    glm::dvec2 focal_px{0.0};   ///< fx, fy; above 0
    glm::dvec2 centre_px{0.0};  ///< cx, cy
};

/// Square pixels, the optical axis through the picture's middle.
Pinhole pinhole_of(const glm::ivec2& size_px, double vertical_field_of_view_rad);

/// The pose of a thing's own axes in patient LPS. A camera's axes are right, down, forward.
struct Pose {
    glm::dvec3 position_mm{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; w, x, y, z
};

/// Columns are unit and at right angles to each other, right-handed.
Pose pose_of(const glm::dvec3& position_mm, const glm::dmat3& axes);
/// Looks from `eye_mm` at `target_mm`, with `up` upward in the picture as far as that is at right angles;
/// which way is free where `up` is along the line of sight.
Pose looking_at(const glm::dvec3& eye_mm, const glm::dvec3& target_mm, const glm::dvec3& up);
Pose pose_of(const Camera& camera);

/// The camera's viewpoint; for a pair of eyes, the point between them.
Viewpoint viewpoint_of(const Camera& camera);

/// Gives a camera that pose and a pinhole's projection; near and far planes stay. Its pivot, for whose depth
/// the scale bar holds, comes onto the line of sight as deep as it was, or to the near plane if it was not
/// before it.
void look_through(Camera& camera, const Pinhole& pinhole, const Pose& pose);

/// The camera to draw with: its near and far planes enclose a ball.
Camera camera_of(const Pinhole& pinhole, const Pose& pose, const glm::dvec3& ball_centre_mm,
                 double ball_radius_mm);

}  // namespace osteomill
