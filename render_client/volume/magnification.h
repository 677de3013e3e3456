// Magnification of the view, in the steps of an operating microscope's changer. The eye stays where it is;
// the angle that it sees becomes narrower or wider.
#pragma once

#include <array>

#include "render_client/volume/camera.h"

namespace osteomill {

/// 1 is Camera's own angle.
inline constexpr std::array magnification_steps{0.4, 0.6, 1.0, 1.6, 2.5};

double magnification(const Camera& camera);
/// Must be positive.
void set_magnification(Camera& camera, double factor);
/// To the next larger or smaller step, if there is one.
void magnify_by_step(Camera& camera, bool larger);

}  // namespace osteomill
