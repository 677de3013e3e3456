// An arm that is not there, moved by an operator over the network: the mouse moves the hand's target, the
// hand and arm model do the rest, so that the operator's tool yields to bone as an arm in a hand would.
#pragma once

#include "common/scene/scene.h"
#include "haptic_server/device/haptic_device.h"
#include "haptic_server/device/held_arm.h"
#include "haptic_server/exchange/operator_input.h"
#include "haptic_server/exchange/triple_buffer.h"

namespace osteomill {

class ClientDevice final : public HapticDevice {
  public:
    /// Mouse positions come some 30 times a second: the target follows them with this time constant...
    static constexpr double target_filter_s = 0.04;
    /// ...and no faster than a hand moves a handpiece.
    static constexpr double target_limit_mm_per_s = 200.0;

    /// Reads `input` as its only reader. The arm starts at rest at `start_pose` (patient LPS). While no
    /// operator is present the hand holds its target and the pedal is up; an input that is not finite is
    /// passed over.
    ClientDevice(TripleBuffer<OperatorInput>& input, const ToolPose& start_pose, const DeviceMapping& mapping,
                 const ArmModel& arm, const HandModel& hand);

    std::string name() const override { return "operator over the network"; }
    DeviceLimits limits() const override { return limits_of(arm_); }
    void start() override {}
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override { held_arm_.set_motor_force(force_n); }
    void stop() noexcept override { held_arm_.set_motor_force(glm::dvec3(0.0)); }

  private:
    void take_over_input() noexcept;

    TripleBuffer<OperatorInput>& input_;
    DeviceMapping mapping_;
    ArmModel arm_;
    HeldArm held_arm_;
    ToolPose wanted_;  // patient LPS
    ToolPose target_;  // on the way to wanted_
    bool pedal_ = false;
    std::optional<std::size_t> burr_;
    double read_at_s_ = 0.0;
};

}  // namespace osteomill
