// The last stage of the force before the hand: it is finite, within the device's limit and rate of change,
// fades out on any fault, and in again after it.
//
//             fault                faded out              no fault for settle_s
//   active ----------> fading out -----------> off --------------------------> fading in
//     ^                    ^                    | ^ (stays off while the fault     |  |
//     |                    |                    +-+  lasts)                        |  |
//     |                    +----------------------- fault -------------------------+  |
//     +------------------------------- faded in --------------------------------------+
//
//   active      the hand feels the wanted force, clamped and slew-limited
//   fading out  the force last written shrinks linearly to zero within fade_out_s; what is wanted is not read
//   off         zero
//   fading in   the wanted force times a gain that grows linearly from 0 to 1 over fade_in_s
//
// No state holds or repeats an old force: fading out only ever shrinks it.
//
// Other bounds on how fast a force changes: ArmSpring::felt_jump_n (simulation/device/arm_spring.h) a tick,
// for a spring that meets or leaves bone; FadeOut (simulation/device/fade_out.h), for a driver whose
// loop falls silent; MeasuringGuard (haptic_server/measuring/measuring_guard.h), while an arm is measured.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/device/fade_out.h"
#include "simulation/safety/fault.h"

namespace osteomill {

class ForceGuard {
  public:
    enum class State { active, fading_out, off, fading_in };

    static constexpr double fade_out_s = FadeOut::fade_s;
    /// Least time without a fault before the force returns; keeps a fault that comes and goes from drumming
    /// on the hand.
    static constexpr double settle_s = 0.1;
    /// Slow enough for a hand to notice and brace.
    static constexpr double fade_in_s = 0.25;
    /// Full force of an Omni in 3.3 ms. A wall met at 300 mm/s with 2 N/mm needs 600 N/s; a faster rise is a
    /// knock that no bone gives.
    static constexpr double slew_n_per_s = 1000.0;

    explicit ForceGuard(double max_force_n) : max_force_n_(max_force_n) {}

    /// The force for a tick of `tick_s`: of length at most max_force_n, whatever is wanted. A wanted force
    /// that is not finite counts as Fault::not_a_number if `fault` is none. Real-time safe.
    glm::dvec3 tick(const glm::dvec3& wanted_n, Fault fault, double tick_s) noexcept;

    State state() const { return state_; }
    /// Whether the tool may touch bone: in `fading_in` and `active`.
    bool is_engaged() const { return state_ == State::active || state_ == State::fading_in; }
    /// Why the force is off; none while engaged.
    Fault fault() const { return is_engaged() ? Fault::none : fault_; }

  private:
    glm::dvec3 approach(const glm::dvec3& wanted_n, double tick_s) const noexcept;

    double max_force_n_;
    State state_ = State::active;
    Fault fault_ = Fault::none;
    double in_state_s_ = 0.0;  // fading in, fading out; off: since the fault was last seen
    glm::dvec3 force_n_{0.0};  // last returned
    glm::dvec3 faded_n_{0.0};  // what fading out began from
};

}  // namespace osteomill
