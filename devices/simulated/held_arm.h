// A simulated arm in a simulated hand, seen from the driver's side: brought up to a time, it tells what the
// encoders say. What the simulated and the client-driven device share. Device space.
#pragma once

#include "devices/position_sensor.h"
#include "devices/simulated/arm_and_hand.h"

namespace osteomill {

class HeldArm {
  public:
    /// Time that one call makes up for at most, so that a call stays short: a machine that was suspended
    /// for longer finds the arm where it was.
    static constexpr double longest_catch_up_s = 0.1;

    HeldArm(const ArmModel& arm, const HandModel& hand, const glm::dvec3& start_mm);

    /// Integrates up to `now_s` (session time, from 0) while the hand's target moves on a straight line to
    /// `target_mm`, with its spindle along `spindle_axis` (unit). Real-time safe.
    void advance(double now_s, const glm::dvec3& target_mm, const glm::dvec3& spindle_axis) noexcept;

    /// Force of the motors from now on; more than they can give is cut off, what is not finite is none.
    /// Real-time safe.
    void set_motor_force(const glm::dvec3& force_n) noexcept;

    /// As the encoders read it at the last advance.
    const PositionSensor& sensor() const { return sensor_; }
    /// Where the arm really is.
    const ArmAndHand& truth() const { return motion_; }

  private:
    ArmModel arm_;
    ArmAndHand motion_;
    PositionSensor sensor_;
    glm::dvec3 target_mm_;
    glm::dvec3 motor_force_n_{0.0};
    long long substeps_done_ = 0;
    double read_at_s_ = 0.0;
};

}  // namespace osteomill
