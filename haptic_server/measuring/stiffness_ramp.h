// The second half of a measurement: the hand holds the arm at a place, a spring and the coupling's damper
// pull it there, the arm taps it, and the spring gets stiffer from tap to tap, until the arm swings on
// instead of coming to rest.
//
//     F = -K (x^ - p) - B v      x^ through the observer of a wall, v of it through tau_x (coupling_spring.h
//                                with a burr that stands); p follows the hand within 0.4 s
//
//     waiting --pedal--> tap, listen 300 ms --came to rest--> K <- 1.08 K, tap ... --K = stiffest--> over
//                              |        ^
//                              |        +--again with the same K--+
//                              +--swings on---------------------->+--swings on again--> over: limit cycle
//                              +--swings beyond farthest_swing_mm-----------------------> over: limit cycle
//
// Each tap has the momentum of what moves at 30 mm/s, as if it met a wall, on all axes at once: friction
// stills small swings and hides a limit cycle from a hand that only rests.
//
// An axis swings on if, 170 to 290 ms after the tap, its rms is
//   - felt: over a step, four times the noise, 0.02 mm, and the sway of the hand at rest;
//   - not dying: at least 0.75 of that 50 to 170 ms after the tap;
//   - driven by the spring: spring and damper took less than a quarter of B v^2. A passive spring takes all
//   of
//     it, and on a limit cycle none is left (the passivity observer of Hannaford and Ryu, IEEE Trans.
//     Robotics and Automation 18:1, 2002). A hand that shakes drives the arm itself: then the damper takes
//     energy.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "haptic_server/measuring/arm_estimates.h"
#include "haptic_server/measuring/measuring_guard.h"
#include "simulation/coupling/position_observer.h"

namespace osteomill {

/// The arm, as far as it has been measured.
struct RampedArm {
    double damping_n_s_per_mm = 0.004;
    double resolution_mm = 0.0;
    double noise_mm = 0.0;
    double moving_mass_kg = 0.1;
    double friction_n = 0.0;
    double delay_ticks = 0.0;
    double sway_mm = 0.0;  ///< rms of the hand at rest, over 120 ms: sway_mm() below
};

class StiffnessRamp {
  public:
    static constexpr double softest_n_per_mm = 0.3;
    /// Half as much again as any arm gets, with which a touch is a jump (arm_spring.h).
    static constexpr double stiffest_n_per_mm = 6.0;
    static constexpr double growth = 1.08;
    static constexpr std::size_t listen_ticks = 300;
    static constexpr double tap_mm_per_s = 30.0;
    static constexpr double farthest_swing_mm = 1.5;
    static constexpr double place_filter_s = 0.4;
    static constexpr std::size_t most_taps = 100;

    /// `guard`: as it was after the part before (MeasuringGuard::again), or a new one.
    StiffnessRamp(const RampedArm& arm, const MeasuringGuard& guard);

    /// Takes the arm's state at `now_s` and returns the force to write. Real-time safe.
    glm::dvec3 tick(const DeviceState& arm, double now_s) noexcept;

    bool has_begun() const noexcept { return guard_.is_open() || is_over(); }
    bool is_over() const noexcept { return guard_.end() != MeasuringEnd::none; }
    MeasuringEnd end() const noexcept { return guard_.end(); }

    /// The stiffest spring so far on which the arm came to rest; 0: none.
    double calm_n_per_mm() const noexcept { return calm_n_per_mm_; }
    /// The first on which it swung on; 0: it was calm on all.
    double swinging_n_per_mm() const noexcept { return swinging_n_per_mm_; }

  private:
    glm::dvec3 spring_n(const glm::dvec3& position_mm, double elapsed_s) noexcept;
    glm::dvec3 tap_n() const noexcept;
    bool swings_on(std::size_t axis) const noexcept;
    bool is_swinging() const noexcept;
    void judge(bool swings) noexcept;

    std::span<const MeasuredTick> since_tap() const noexcept { return record_.from(tap_begins_); }

    RampedArm arm_;
    MeasuringGuard guard_;
    PositionObserver observer_;
    TickRecord record_;
    glm::dvec3 place_mm_{0.0};
    glm::dvec3 estimate_mm_{0.0};
    glm::dvec3 velocity_mm_per_s_{0.0};
    double stiffness_n_per_mm_ = softest_n_per_mm;
    double calm_n_per_mm_ = 0.0;
    double swinging_n_per_mm_ = 0.0;
    std::size_t tap_begins_ = 0;  // in the record
    std::size_t taps_ = 0;
    std::size_t tap_ticks_ = 0;
    double tap_n_ = 0.0;
    bool swung_before_ = false;  // on the same spring
};

/// rms of a hand that rests, mm: of the axis that sways most, over windows as long as those of a ramp, less
/// their means. At least 120 ticks. Not real-time safe.
double sway_mm(std::span<const MeasuredTick> at_rest);

}  // namespace osteomill
