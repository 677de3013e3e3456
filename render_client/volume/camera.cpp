#include "render_client/volume/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace osteomill {

namespace {

constexpr double steepest_rad = 89.0 * std::numbers::pi / 180.0;

}  // namespace

glm::dvec3 Camera::forward() const {
    const double level = std::cos(elevation_rad);
    return {-std::sin(azimuth_rad) * level, std::cos(azimuth_rad) * level, -std::sin(elevation_rad)};
}

glm::dvec3 Camera::eye_mm() const {
    return target_mm - distance_mm * forward() + eye_right_mm * right();
}

glm::dvec3 Camera::right() const {
    const glm::dvec3 level{std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0};
    return std::cos(roll_rad) * level + std::sin(roll_rad) * glm::cross(level, forward());
}

glm::dvec3 Camera::up() const {
    return glm::cross(right(), forward());
}

bool Camera::has_in_front(const glm::dvec3& position_mm) const {
    return glm::dot(position_mm - eye_mm(), forward()) >= near_mm;
}

glm::dmat4 Camera::view() const {
    return glm::lookAt(eye_mm(), eye_mm() + forward(), up());
}

glm::dvec2 Camera::half_extent(const glm::ivec2& size_px) const {
    const double half_height = std::tan(0.5 * field_of_view_rad);
    return {half_height * pixel_aspect * size_px.x / std::max(size_px.y, 1), half_height};
}

glm::dvec3 Camera::middle_ray() const {
    return forward() + middle_slope * right() + middle_rise * up();
}

glm::dmat4 Camera::projection(const glm::ivec2& size_px) const {
    const double aspect = pixel_aspect * size_px.x / std::max(size_px.y, 1);
    glm::dmat4 projection = glm::perspective(field_of_view_rad, aspect, near_mm, far_mm);
    projection[2][0] = middle_slope / half_extent(size_px).x;
    projection[2][1] = middle_rise / half_extent(size_px).y;
    return projection;
}

Camera camera_on(const glm::dvec3& centre_mm, double radius_mm) {
    Camera camera;
    camera.target_mm = centre_mm;
    camera.distance_mm = 0.85 * radius_mm / std::sin(0.5 * camera.field_of_view_rad);
    camera.azimuth_rad = 0.35;
    camera.elevation_rad = 0.75;
    camera.near_mm = 0.01 * radius_mm;
    camera.far_mm = 20.0 * radius_mm;
    return camera;
}

void look_along(Camera& camera, const glm::dvec3& forward) {
    camera.azimuth_rad = std::atan2(-forward.x, forward.y);
    camera.elevation_rad = std::asin(std::clamp(-forward.z, -1.0, 1.0));
}

void orbit(Camera& camera, double azimuth_change_rad, double elevation_change_rad) {
    camera.azimuth_rad = std::remainder(camera.azimuth_rad + azimuth_change_rad, 2.0 * std::numbers::pi);
    camera.elevation_rad =
        std::clamp(camera.elevation_rad + elevation_change_rad, -steepest_rad, steepest_rad);
}

void pan(Camera& camera, const glm::dvec2& moved_px, const glm::ivec2& size_px) {
    const double mm_per_px = mm_per_px_at(camera, camera.target_mm, size_px);
    camera.target_mm +=
        mm_per_px * (moved_px.y * camera.up() - camera.pixel_aspect * moved_px.x * camera.right());
}

void zoom(Camera& camera, double distance_factor) {
    camera.distance_mm =
        std::clamp(camera.distance_mm * distance_factor, 5.0 * camera.near_mm, 0.75 * camera.far_mm);
}

double mm_per_px_at(const Camera& camera, const glm::dvec3& position_mm, const glm::ivec2& size_px) {
    const double depth_mm = glm::dot(position_mm - camera.eye_mm(), camera.forward());
    return 2.0 * depth_mm * std::tan(0.5 * camera.field_of_view_rad) / std::max(size_px.y, 1);
}

glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& position_mm, const glm::ivec2& size_px) {
    const double mm_per_px = mm_per_px_at(camera, position_mm, size_px);
    const glm::dvec3 from_eye = position_mm - camera.eye_mm();
    const double depth_mm = glm::dot(from_eye, camera.forward());
    const double right_mm = glm::dot(from_eye, camera.right()) - camera.middle_slope * depth_mm;
    const double up_mm = glm::dot(from_eye, camera.up()) - camera.middle_rise * depth_mm;
    return {0.5 * size_px.x + right_mm / (camera.pixel_aspect * mm_per_px),
            0.5 * size_px.y - up_mm / mm_per_px};
}

glm::dvec3 direction_through(const Camera& camera, const glm::dvec2& pixel, const glm::ivec2& size_px) {
    const glm::dvec2 from_middle =
        camera.half_extent(size_px) * (2.0 * pixel / glm::max(glm::dvec2(size_px), 1.0) - 1.0);
    return glm::normalize(camera.middle_ray() + from_middle.x * camera.right() - from_middle.y * camera.up());
}

namespace {

double slope_of_edge(const Camera& camera) {
    return std::tan(0.5 * camera.field_of_view_rad);
}

/// Tolerance of a value that was converted to the angle and back.
constexpr double tolerance = 1e-6;

}  // namespace

double magnification(const Camera& camera) {
    return slope_of_edge(Camera{}) / slope_of_edge(camera);
}

void set_magnification(Camera& camera, double factor) {
    camera.field_of_view_rad = 2.0 * std::atan(slope_of_edge(Camera{}) / factor);
}

void magnify_by_step(Camera& camera, bool larger) {
    const double now = magnification(camera);
    double next = now;
    for (const double step : magnification_steps) {
        if (larger && step > now + tolerance) {
            next = step;
            break;
        }
        if (!larger && step < now - tolerance) next = step;
    }
    set_magnification(camera, next);
}

std::optional<PixelBox> pixels_of_box(const Camera& camera, const glm::dvec3& low_mm,
                                      const glm::dvec3& high_mm, const glm::ivec2& size_px) {
    glm::dvec2 first(size_px), last(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place(corner & 1 ? high_mm.x : low_mm.x, corner & 2 ? high_mm.y : low_mm.y,
                               corner & 4 ? high_mm.z : low_mm.z);
        if (!camera.has_in_front(place)) return std::nullopt;
        const glm::dvec2 pixel = pixel_of(camera, place, size_px);
        first = glm::min(first, pixel);
        last = glm::max(last, pixel);
    }
    const glm::ivec2 low = glm::clamp(glm::ivec2(glm::floor(first)) - 1, glm::ivec2(0), size_px);
    const glm::ivec2 high = glm::clamp(glm::ivec2(glm::ceil(last)) + 1, glm::ivec2(0), size_px);
    const glm::ivec2 size = glm::max(high - low, 0);
    // pixel_of counts rows from the top.
    return PixelBox{{low.x, size_px.y - low.y - size.y}, size};
}

}  // namespace osteomill
