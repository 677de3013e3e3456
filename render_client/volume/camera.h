// The camera: orbits a target, upright unless it is rolled (patient z is up in the picture), perspective; and
// the pixels that can show a box.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

/// Place and direction of the camera, patient LPS. At azimuth 0 it stands in front of the patient (towards
/// -y), at positive elevation above.
struct Camera {
    glm::dvec3 target_mm{0.0};
    double distance_mm = 100.0;
    double azimuth_rad = 0.0;
    double elevation_rad = 0.6;
    double field_of_view_rad = 0.6;  ///< vertical
    double near_mm = 1.0;
    double far_mm = 1000.0;
    double roll_rad = 0.0;      ///< turns the picture's axes about forward(); positive: its right side rises
    double eye_right_mm = 0.0;  ///< how far the eye is to the right of the middle: one of a pair (stereo.h)
    double middle_slope = 0.0;  ///< of the ray through the picture's middle: mm to the right a mm forward
    double middle_rise = 0.0;   ///< the same upwards
    double pixel_aspect = 1.0;  ///< width of a pixel, as it is shown, over its height

    bool operator==(const Camera&) const = default;

    glm::dvec3 eye_mm() const;
    glm::dvec3 forward() const;  ///< unit; right and up complete it to the axes of the picture
    glm::dvec3 right() const;
    glm::dvec3 up() const;
    /// Whether a point is in front of the eye, no nearer than the near plane.
    bool has_in_front(const glm::dvec3& position_mm) const;
    /// Half the picture's width and height at distance 1, `size_px` as below.
    glm::dvec2 half_extent(const glm::ivec2& size_px) const;
    /// The ray through the picture's middle; 1 along forward().
    glm::dvec3 middle_ray() const;
    glm::dmat4 view() const;
    /// OpenGL's clip space; `size_px` is the picture's.
    glm::dmat4 projection(const glm::ivec2& size_px) const;
};

/// A camera from the front and above that sees the whole box.
Camera camera_on(const glm::dvec3& centre_mm, double radius_mm);

/// Turns the camera to look along a unit direction.
void look_along(Camera& camera, const glm::dvec3& forward);
/// Turns round the target; elevation stays within a degree of straight up and down.
void orbit(Camera& camera, double azimuth_change_rad, double elevation_change_rad);
/// Moves target and eye so that points at the target's depth follow the pointer (pixels, y down).
void pan(Camera& camera, const glm::dvec2& moved_px, const glm::ivec2& size_px);
/// Multiplies the distance, within the limits that keep the bone between near and far.
void zoom(Camera& camera, double distance_factor);

/// mm that a pixel's height spans at a point's depth.
double mm_per_px_at(const Camera& camera, const glm::dvec3& position_mm, const glm::ivec2& size_px);

/// Unit direction from the eye through a pixel (y down, from the picture's upper left corner).
glm::dvec3 direction_through(const Camera& camera, const glm::dvec2& pixel, const glm::ivec2& size_px);

/// Pixel (y down, from the picture's upper left corner) at which a point is seen; the point must be in front.
glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& position_mm, const glm::ivec2& size_px);

// Magnification of the view, in the steps of an operating microscope's changer. The eye stays where it is;
// the angle that it sees becomes narrower or wider.

/// 1 is Camera's own angle.
inline constexpr std::array magnification_steps{0.4, 0.6, 1.0, 1.6, 2.5};

double magnification(const Camera& camera);
/// Must be positive.
void set_magnification(Camera& camera, double factor);
/// To the next larger or smaller step, if there is one.
void magnify_by_step(Camera& camera, bool larger);

// The part of the picture that can show a box of patient space.

/// Pixels (from the lower left corner, as glScissor counts) that can show a box of patient space; nothing if
/// the box reaches behind the camera, so that any pixel could show it.
struct PixelBox {
    glm::ivec2 first{0};
    glm::ivec2 size{0};

    bool operator==(const PixelBox&) const = default;
    std::int64_t count() const { return static_cast<std::int64_t>(size.x) * size.y; }
};
std::optional<PixelBox> pixels_of_box(const Camera& camera, const glm::dvec3& low_mm,
                                      const glm::dvec3& high_mm, const glm::ivec2& size_px);

}  // namespace osteomill
