// A haptic arm in a hand that follows a trajectory; no hardware. Deterministic: what it reads depends on the
// trajectory, the forces written and the times of reading, and on nothing else.
#pragma once

#include "common/scene/scene.h"
#include "haptic_server/device/haptic_device.h"
#include "haptic_server/device/held_arm.h"
#include "haptic_server/device/trajectory.h"

namespace osteomill {

class SimulatedDevice final : public HapticDevice {
  public:
    /// The trajectory is in patient space; `mapping` takes it to device space. The arm starts at rest where
    /// the trajectory begins.
    SimulatedDevice(Trajectory trajectory, const DeviceMapping& mapping, const ArmModel& arm,
                    const HandModel& hand);

    std::string name() const override { return "simulated arm"; }
    DeviceLimits limits() const override { return limits_of(arm_); }
    void start() override {}
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override { held_arm_.set_motor_force(force_n); }
    void stop() noexcept override { held_arm_.set_motor_force(glm::dvec3(0.0)); }

    const HeldArm& held_arm() const { return held_arm_; }

  private:
    Trajectory trajectory_;
    DeviceMapping mapping_;
    ArmModel arm_;
    HeldArm held_arm_;
};

}  // namespace osteomill
