#include "render_client/volume/magnification.h"

#include <cmath>

namespace osteomill {

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

}  // namespace osteomill
