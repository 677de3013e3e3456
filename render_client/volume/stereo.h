// Two eyes for one camera: off-axis projection, and how their two pictures share one.
//
// The eyes stand interpupillary_mm apart, side by side, and look in parallel; the frusta are shifted so that
// both pictures show the same piece of the plane at convergence_mm. A point at depth z is seen further to the
// right by the left eye, by
//     f b (1/z - 1/c)  pixels,   f = half a picture's width / the tangent of half its angle,
// b and c in mm: none at the convergence, in front of the display nearer, behind it farther
// (Bourke, "Calculating stereo pairs", 1999). Turned-in axes would give vertical disparity, which hurts.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "render_client/volume/camera.h"

namespace osteomill {

enum class Eye { left, right };

/// Layouts of the two pictures in one. The layouts of half the pixels are a 3D display's of the same name: it
/// stretches each to its whole size.
enum class StereoLayout {
    off,           ///< one eye in the middle
    side_by_side,  ///< left eye left, each half as wide
    top_bottom,    ///< left eye above, each half as high
    rows,          ///< even rows, from the top row on, are the left eye's
    quad_buffer    ///< the driver has a back buffer for each eye; each in full
};

/// Share of an operating microscope: 24 mm between its paths of light, 300 mm above the bone.
inline constexpr double interpupillary_part = 0.08;

struct StereoSettings {
    StereoLayout layout = StereoLayout::off;
    std::optional<double> interpupillary_mm{};  ///< absent: interpupillary_part of the convergence
    std::optional<double> convergence_mm{};     ///< absent: the distance of the camera's target

    bool operator==(const StereoSettings&) const = default;
};

/// The camera of one eye.
Camera eye_camera(const Camera& middle, const StereoSettings& settings, Eye eye);

/// Size of each eye's picture in one of `size_px`, at least a pixel; its pixels have pixel_aspect_of().
glm::ivec2 eye_size_px(StereoLayout layout, const glm::ivec2& size_px);
double pixel_aspect_of(StereoLayout layout);

}  // namespace osteomill
