#include "render_client/dataset/pinhole.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace osteomill {

Pinhole pinhole_of(const glm::ivec2& size_px, double vertical_field_of_view_rad) {
    const double focal_px = 0.5 * size_px.y / std::tan(0.5 * vertical_field_of_view_rad);
    return {size_px, glm::dvec2(focal_px), 0.5 * (glm::dvec2(size_px) - 1.0)};
}

Pose pose_of(const glm::dvec3& position_mm, const glm::dmat3& axes) {
    glm::dquat rotation = glm::normalize(glm::quat_cast(axes));
    // A rotation has two quaternions; this chooses the one with w above 0.
    if (rotation.w < 0.0) rotation = -rotation;
    return {position_mm, rotation};
}

Pose looking_at(const glm::dvec3& eye_mm, const glm::dvec3& target_mm, const glm::dvec3& up) {
    const glm::dvec3 forward = glm::normalize(target_mm - eye_mm);
    glm::dvec3 right = glm::cross(forward, up);
    if (glm::length(right) < 1e-9 * glm::length(up))
        right = glm::cross(forward, std::abs(forward.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
    right = glm::normalize(right);
    return pose_of(eye_mm, glm::dmat3(right, glm::cross(forward, right), forward));
}

Pose pose_of(const Camera& camera) {
    return pose_of(camera.eye_mm(), glm::dmat3(camera.right(), -camera.up(), camera.forward()));
}

Viewpoint viewpoint_of(const Camera& camera) {
    Camera middle = camera;
    middle.eye_right_mm = 0.0;
    const Pose pose = pose_of(middle);
    return {pose.position_mm, pose.rotation, camera.field_of_view_rad};
}

void look_through(Camera& camera, const Pinhole& pinhole, const Pose& pose) {
    const glm::dmat3 axes = glm::mat3_cast(pose.rotation);
    const glm::dvec3 right = axes[0], forward = axes[2];
    look_along(camera, forward);
    const bool is_upright = std::abs(forward.z) > 1.0 - 1e-12;
    if (is_upright) camera.azimuth_rad = std::atan2(right.y, right.x);
    camera.roll_rad = std::atan2(glm::dot(right, camera.up()), glm::dot(right, camera.right()));
    camera.distance_mm =
        std::max(glm::dot(camera.target_mm - pose.position_mm, camera.forward()), camera.near_mm);
    camera.target_mm = pose.position_mm + camera.distance_mm * camera.forward();

    const glm::dvec2 size(pinhole.size_px);
    camera.field_of_view_rad = 2.0 * std::atan(0.5 * size.y / pinhole.focal_px.y);
    camera.pixel_aspect = pinhole.focal_px.y / pinhole.focal_px.x;
    camera.middle_slope = (0.5 * (size.x - 1.0) - pinhole.centre_px.x) / pinhole.focal_px.x;
    camera.middle_rise = (pinhole.centre_px.y - 0.5 * (size.y - 1.0)) / pinhole.focal_px.y;
}

Camera camera_of(const Pinhole& pinhole, const Pose& pose, const glm::dvec3& ball_centre_mm,
                 double ball_radius_mm) {
    Camera camera;
    look_through(camera, pinhole, pose);
    camera.near_mm = 0.01 * ball_radius_mm;
    camera.far_mm = glm::distance(pose.position_mm, ball_centre_mm) + 20.0 * ball_radius_mm;
    return camera;
}

}  // namespace osteomill
