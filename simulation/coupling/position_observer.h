// Observer of the hand's position between the steps of its encoder: a predictor, corrected only by as much as
// the reading proves.
//
//     p = x^ + v^ dt + (x - x^) dt / tau           prediction
//     r = x - p,  o = r - clamp(r, -q/2, q/2)      how far p lies outside the encoder's cell around x
//     s = clamp(o, -q, q),  h = o - s              up to a step of it, and what is beyond
//     x^ = p + c s + h,  v^ += (a s + b h) / dt    (an alpha-beta filter with a dead zone)
//     |v^| <= q / t                                t: for which the reading has stayed within half a step
//
// Within a cell nothing is proven, and the estimate is drawn to its middle, from which it strays by no more
// than v^ tau. If it stayed at the edge where the last motion brought it, it would have to jump a whole step
// when the hand leaves by the other edge. A hand that moved on would have reached the next cell, so v^ falls
// the longer the reading stays; otherwise the burr would stay v^ tau ahead of a hand that stands still.
//
// A steadily moving hand reads as a staircase; rendered by a spring of 1.7 N/mm each step of 0.055 mm would
// be felt as 0.09 N. The estimate glides instead. While bone is cut, an unexpected step is made up for within
// some ten ticks (c = 0.1, a = 0.01); at once, it would be felt as a tap. It strays from the cell by no more
// than a step, so a fast hand is followed without a low-pass filter's lag. On a wall the arm would swing on
// that lag, and there c = 1, a = b: the estimate never leaves the cell. With q = 0 it is the reading.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/device/arm_spring.h"

namespace osteomill {

class PositionObserver {
  public:
    /// b: share of a correction that goes into the velocity; 1 / b ticks of memory.
    static constexpr double velocity_share = 0.05;
    /// c and a, while bone is cut.
    static constexpr double gentle_share = ArmSpring::share_of_step;
    static constexpr double gentle_velocity_share = 0.01;
    /// tau, s: longer than the swing of an arm on a stiff wall, shorter than the stops of a hand that sticks
    /// and slips.
    static constexpr double settling_s = 0.02;

    /// `resolution_mm` is the encoder's step along each axis, 0 if it is negligible.
    explicit PositionObserver(double resolution_mm) : half_step_mm_(0.5 * resolution_mm) {}

    void reset() noexcept { placed_ = false; }

    /// Takes the reading of a tick of `tick_s` > 0 and returns the estimate. `on_wall`: bone, if there is
    /// any, is or may be a wall that is not cut. The first reading after a reset is taken as it is. Real-time
    /// safe.
    const glm::dvec3& update(const glm::dvec3& reading_mm, double tick_s, bool on_wall = true) noexcept {
        if (!placed_) {
            estimate_mm_ = reading_mm;
            velocity_mm_per_s_ = glm::dvec3(0.0);
            stayed_at_mm_ = reading_mm;
            stayed_s_ = glm::dvec3(0.0);
            placed_ = true;
            return estimate_mm_;
        }
        const glm::dvec3 predicted = estimate_mm_ + velocity_mm_per_s_ * tick_s +
                                     std::min(1.0, tick_s / settling_s) * (reading_mm - estimate_mm_);
        const glm::dvec3 off = reading_mm - predicted;
        const glm::dvec3 outside = off - glm::clamp(off, -half_step_mm_, half_step_mm_);
        const glm::dvec3 first_step = glm::clamp(outside, -2.0 * half_step_mm_, 2.0 * half_step_mm_);
        const glm::dvec3 beyond = outside - first_step;
        const double share = on_wall ? 1.0 : gentle_share;
        estimate_mm_ = half_step_mm_ > 0.0 ? predicted + share * first_step + beyond : reading_mm;
        velocity_mm_per_s_ +=
            ((on_wall ? velocity_share : gentle_velocity_share) * first_step + velocity_share * beyond) /
            tick_s;
        slow_down(reading_mm, tick_s);
        return estimate_mm_;
    }

  private:
    void slow_down(const glm::dvec3& reading_mm, double tick_s) noexcept {
        for (int i = 0; i < 3; ++i) {
            stayed_s_[i] += tick_s;
            if (std::abs(reading_mm[i] - stayed_at_mm_[i]) >= half_step_mm_) {
                stayed_at_mm_[i] = reading_mm[i];
                stayed_s_[i] = 0.0;
                continue;
            }
            const double most_mm_per_s = 2.0 * half_step_mm_ / stayed_s_[i];
            velocity_mm_per_s_[i] = std::clamp(velocity_mm_per_s_[i], -most_mm_per_s, most_mm_per_s);
        }
    }

    double half_step_mm_;
    bool placed_ = false;
    glm::dvec3 estimate_mm_{0.0};
    glm::dvec3 velocity_mm_per_s_{0.0};
    glm::dvec3 stayed_at_mm_{0.0};
    glm::dvec3 stayed_s_{0.0};
};

}  // namespace osteomill
