// The motion of an arm held by a hand, integrated in small fixed steps.
//
// Semi-implicit Euler: velocity first, with damping taken at the step's end, then position with the new
// velocity. Coulomb friction is an impulse of at most F_f dt against the velocity that the other forces would
// leave; if it would reverse the motion, the arm stands still. So it sticks and slips without a threshold
// speed and never adds energy.
#pragma once

#include <glm/vec3.hpp>

#include "devices/simulated/arm_model.h"
#include "devices/simulated/hand_model.h"

namespace osteomill {

/// The tool's place as the person intends it, device space.
struct HandTarget {
    glm::dvec3 position_mm{0.0};
    glm::dvec3 velocity_mm_per_s{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit
};

class ArmAndHand {
  public:
    /// 20 us: 1/50 of a haptic tick, 1/250 of the shortest time constant in it (arm against a 1.7 N/mm
    /// spring).
    static constexpr double substep_s = 20e-6;

    ArmAndHand(const ArmModel& arm, const HandModel& hand, const glm::dvec3& start_mm);

    /// One substep under a force of the motors on the arm, device space. Real-time safe.
    void step(const HandTarget& target, const glm::dvec3& motor_force_n) noexcept;

    const glm::dvec3& position_mm() const { return position_mm_; }
    const glm::dvec3& velocity_mm_per_s() const { return velocity_mm_per_s_; }
    /// Gives the arm a velocity, as a push would.
    void set_velocity(const glm::dvec3& velocity_mm_per_s) { velocity_mm_per_s_ = velocity_mm_per_s; }

  private:
    glm::dvec3 spring_force_n(const HandTarget& target) noexcept;

    ArmModel arm_;
    HandModel hand_;
    glm::dvec3 position_mm_;
    glm::dvec3 velocity_mm_per_s_{0.0};
    glm::dvec3 correction_mm_{0.0};
};

}  // namespace osteomill
