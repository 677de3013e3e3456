#include "render_client/volume/stereo.h"

#include <glm/common.hpp>

namespace osteomill {

Camera eye_camera(const Camera& middle, const StereoSettings& settings, Eye eye) {
    Camera camera = middle;
    const double convergence_mm = settings.convergence_mm.value_or(middle.distance_mm);
    const double apart_mm = settings.interpupillary_mm.value_or(interpupillary_part * convergence_mm);
    camera.eye_right_mm = (eye == Eye::left ? -0.5 : 0.5) * apart_mm;
    camera.middle_slope = -camera.eye_right_mm / convergence_mm;
    camera.pixel_aspect = pixel_aspect_of(settings.layout);
    return camera;
}

glm::ivec2 eye_size_px(StereoLayout layout, const glm::ivec2& size_px) {
    const bool halves_width = layout == StereoLayout::side_by_side;
    const bool halves_height = layout == StereoLayout::top_bottom || layout == StereoLayout::rows;
    return glm::max(size_px / glm::ivec2(halves_width ? 2 : 1, halves_height ? 2 : 1), 1);
}

double pixel_aspect_of(StereoLayout layout) {
    switch (layout) {
        case StereoLayout::side_by_side:
            return 2.0;
        case StereoLayout::top_bottom:
        case StereoLayout::rows:
            return 0.5;
        case StereoLayout::off:
        case StereoLayout::quad_buffer:
            break;
    }
    return 1.0;
}

}  // namespace osteomill
