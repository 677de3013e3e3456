// Observer of the hand's position between the steps of its encoder: a predictor that is corrected only by
// what the reading proves.
//
//     p = x^ + v^ dt + (x - x^) dt / tau  prediction
//     r = x - p,  d = r - clamp(r, -q/2, q/2)      how far p lies outside the encoder's cell around x
//     x^ = p + d,  v^ += b d / dt         (an alpha-beta filter with a dead zone)
//
// Within a cell nothing is proven, and the estimate is drawn to its middle, from which it strays by no more
// than v^ tau. Left at the edge where the last motion brought it, it would have to jump a whole step when the
// hand leaves by the other one.
//
// A steadily moving hand reads as a staircase; rendered by a spring of 1.5 N/mm each step of 0.055 mm would
// be felt as 0.08 N. The estimate glides instead, never leaves the cell, and so lags by no more than half a
// step: no phase is lost, as it would be to a low-pass filter. With q = 0 it is the reading.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

class PositionObserver {
  public:
    /// Share of a correction that goes into the velocity; 1 / b ticks of memory.
    static constexpr double velocity_share = 0.05;
    /// tau, s: longer than the swing of an arm on a stiff wall, shorter than the stops of a hand that sticks
    /// and slips.
    static constexpr double settling_s = 0.02;

    /// `resolution_mm` is the encoder's step along each axis, 0 where it has none to speak of.
    explicit PositionObserver(double resolution_mm) : half_step_mm_(0.5 * resolution_mm) {}

    void reset() noexcept { placed_ = false; }

    /// Takes the reading of a tick of `tick_s` > 0 and returns the estimate. The first reading after a reset
    /// is taken as it is. Real-time safe.
    const glm::dvec3& update(const glm::dvec3& reading_mm, double tick_s) noexcept {
        if (!placed_) {
            estimate_mm_ = reading_mm;
            velocity_mm_per_s_ = glm::dvec3(0.0);
            placed_ = true;
            return estimate_mm_;
        }
        const glm::dvec3 predicted = estimate_mm_ + velocity_mm_per_s_ * tick_s +
                                     std::min(1.0, tick_s / settling_s) * (reading_mm - estimate_mm_);
        const glm::dvec3 off = reading_mm - predicted;
        const glm::dvec3 outside = off - glm::clamp(off, -half_step_mm_, half_step_mm_);
        estimate_mm_ = half_step_mm_ > 0.0 ? predicted + outside : reading_mm;
        velocity_mm_per_s_ += velocity_share / tick_s * outside;
        return estimate_mm_;
    }

  private:
    double half_step_mm_;
    bool placed_ = false;
    glm::dvec3 estimate_mm_{0.0};
    glm::dvec3 velocity_mm_per_s_{0.0};
};

}  // namespace osteomill
