// A simulated arm in a simulated hand, seen from the driver's side: integrated up to a given time, it returns
// the encoder readings. The common part of the simulated and the client-driven device. Device space.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "devices/position_sensor.h"
#include "devices/simulated/hand_and_arm.h"

namespace osteomill {

// The motion of an arm held by a hand, integrated in small fixed steps.
//
// Semi-implicit Euler: velocity first, with damping taken at the step's end, then position with the new
// velocity. Coulomb friction is an impulse of at most F_f dt against the velocity that the other forces would
// leave; if it would reverse the motion, the arm stands still. So it sticks and slips without a threshold
// speed and never adds energy.

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

class HeldArm {
  public:
    /// Longest time that one call integrates, so that calls stay short: after a longer suspension of the
    /// machine the arm is where it was.
    static constexpr double longest_catch_up_s = 0.1;

    HeldArm(const ArmModel& arm, const HandModel& hand, const glm::dvec3& start_mm);

    /// Integrates up to `now_s` (session time, from 0) while the hand's target moves on a straight line to
    /// `target_mm`, with its spindle along `spindle_axis` (unit). Real-time safe.
    void advance(double now_s, const glm::dvec3& target_mm, const glm::dvec3& spindle_axis) noexcept;

    /// Force of the motors from now on, or after the arm's delay if it is set once a ms; clamped to their
    /// maximum, zero if not finite. Real-time safe.
    void set_motor_force(const glm::dvec3& force_n) noexcept;

    /// As the encoders read it at the last advance.
    const PositionSensor& sensor() const { return sensor_; }
    /// The arm's true motion.
    const ArmAndHand& truth() const { return motion_; }

  private:
    ArmModel arm_;
    ArmAndHand motion_;
    PositionSensor sensor_;
    glm::dvec3 target_mm_;
    glm::dvec3 motor_force_n_{0.0};
    std::vector<glm::dvec3> late_n_;  // a ring of forces that do not act yet
    std::size_t next_late_ = 0;
    long long substeps_done_ = 0;
    double read_at_s_ = 0.0;
};

}  // namespace osteomill
