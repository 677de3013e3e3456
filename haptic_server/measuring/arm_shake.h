// The first half of a measurement: the hand rests for a while, then the arm pushes it to and fro along each
// axis in turn, by a millimetre or so. From what is recorded come the encoder's step, noise, mass,
// friction and delay (arm_estimates.h).
//
//   waiting --pedal--> resting --rest_ticks--> pushing x, y, z --push_ticks each--> over
//
// The push is F for h ms, -F for 2 h and F for h, after which a mass is at rest where it was; then the same
// with the other sign and another h, of 6, 10, 17, 25 and 13 ms, so that mass, damping, stiffness and delay
// show each in another way. F grows by 1.4 a group while the arm goes less than enough_mm, to the guard's
// bound, and shrinks where it goes beyond too_far_mm. A soft spring and damper keep a hand that gives way in
// the middle; the force that is recorded has them in it.
#pragma once

#include <array>
#include <cstddef>

#include "haptic_server/measuring/arm_estimates.h"
#include "haptic_server/measuring/measuring_guard.h"

namespace osteomill {

class ArmShake {
  public:
    static constexpr std::size_t rest_ticks = 1500;
    static constexpr std::size_t push_ticks = 2000;
    static constexpr std::array<std::size_t, 5> quarter_periods{6, 10, 17, 25, 13};
    static constexpr double first_push_n = 0.3;
    static constexpr double growth = 1.4;
    static constexpr double enough_mm = 0.8;
    static constexpr double too_far_mm = 1.6;
    static constexpr double middle_n_per_mm = 0.2;
    static constexpr double middle_n_s_per_mm = 0.002;
    static constexpr double middle_filter_s = 0.3;  ///< the middle follows the hand
    static constexpr double speed_filter_s = 0.005;

    explicit ArmShake(double arm_force_n) : guard_(arm_force_n), record_(rest_ticks + 3 * push_ticks) {}

    /// Takes the arm's state at `now_s` and returns the force to write. Real-time safe.
    glm::dvec3 tick(const DeviceState& arm, double now_s) noexcept;

    const MeasuringGuard& guard() const noexcept { return guard_; }
    bool has_begun() const noexcept { return guard_.is_open() || is_over(); }
    bool is_over() const noexcept { return guard_.end() != MeasuringEnd::none; }
    MeasuringEnd end() const noexcept { return guard_.end(); }

    std::span<const MeasuredTick> rest() const { return record_.from(0).first(rest_ticks); }
    /// Along an axis, 0 to 2. Only once done.
    std::span<const MeasuredTick> push(std::size_t axis) const {
        return record_.from(rest_ticks + axis * push_ticks).first(push_ticks);
    }
    std::span<const MeasuredTick> all() const { return record_.from(0); }

  private:
    glm::dvec3 wanted_n(const glm::dvec3& position_mm) noexcept;
    void begin_group() noexcept;

    MeasuringGuard guard_;
    TickRecord record_;
    std::size_t axis_ = 0;
    glm::dvec3 middle_mm_{0.0};
    double push_n_ = first_push_n;
    double sense_ = 1.0;
    std::size_t group_ = 0;
    std::size_t in_group_ = 0;
    double lowest_mm_ = 0.0;  // in the group
    double highest_mm_ = 0.0;
    double last_off_mm_ = 0.0;
    double speed_mm_per_s_ = 0.0;
};

}  // namespace osteomill
