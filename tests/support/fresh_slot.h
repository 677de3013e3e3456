// The force of a burr in a fresh slot, in closed form (upright burr, steady feed along +x, depth d of its lowest point):
//
//     F_x = -(fr/4) (K_r Is + K_a Ic)    F_y = -sigma (fr/4) K_t d    F_z = (fr/pi) (K_r Ic - K_a Is)
//     Is = R (kd/2 - sin(2 kd)/4)        Ic = R sin^2(kd)/2           cos kd = 1 - d/R,  fr = |v| / n_rev
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "common/scene/burr.h"

namespace osteomill::testing {

inline glm::dvec3 fresh_slot_force_n(const Burr& burr, double feed_mm_per_s, double depth_mm) {
    constexpr double pi = 3.14159265358979323846;
    const glm::dvec3& k = burr.cutting_coefficients_n_per_mm2;
    const double r = burr.radius_mm();
    const double kd = std::acos(1.0 - depth_mm / r);
    const double is = r * (kd / 2.0 - std::sin(2.0 * kd) / 4.0);
    const double ic = r * std::sin(kd) * std::sin(kd) / 2.0;
    const double fr = feed_mm_per_s / burr.spindle_rev_per_s;
    return {-fr / 4.0 * (k.y * is + k.z * ic), -burr.sigma() * fr / 4.0 * k.x * depth_mm,
            fr / pi * (k.y * ic - k.z * is)};
}

}  // namespace osteomill::testing
