// An arm that is not there, moved by an operator over the network: the mouse moves the hand's target, the
// hand and arm model do the rest, so that the operator's tool yields to bone as an arm in a hand would.
//
// What an operator says is good for Permission::by_message_s of session time: without a fresh message the
// tick lifts the pedal and the hand stands still, whatever the network's threads do. A pedal that was down
// then has to be lifted and pressed anew: whoever held it while nothing turned may not mean the bone that the
// burr is at when the messages come back. And it is held to what a hand does (TargetLimit): one message moves
// the tool by longest_reach_mm at the most.
#pragma once

#include "common/scene/scene.h"
#include "haptic_server/device/haptic_device.h"
#include "haptic_server/device/held_arm.h"
#include "haptic_server/device/permission.h"
#include "haptic_server/device/target_limit.h"
#include "haptic_server/exchange/operator_channel.h"

namespace osteomill {

class ClientDevice final : public HapticDevice {
  public:
    /// Mouse positions come some 60 times a second: the target follows them with this time constant.
    static constexpr double target_filter_s = 0.04;

    /// Reads `commands` as its only reader. The arm starts at rest at `start_pose` (patient LPS). While no
    /// operator is heard the hand holds its target and the pedal is up. A command that is not finite counts
    /// as none. The burr that targets are kept near is the arm's tip, but for what the coupling yields.
    ClientDevice(OperatorChannel& commands, const ToolPose& start_pose, const DeviceMapping& mapping,
                 const ArmModel& arm, const HandModel& hand);

    std::string name() const override { return "operator over the network"; }
    DeviceLimits limits() const override { return limits_of(arm_); }
    void start() override {}
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override { held_arm_.set_motor_force(force_n); }
    void stop() noexcept override { held_arm_.set_motor_force(glm::dvec3(0.0)); }
    /// The hand stays where it is and holds still until the next command.
    void set_mapping(const DeviceMapping& mapping) noexcept override;
    /// What was clamped, once for each kind.
    const char* notice() const noexcept override { return limit_.notice(); }

  private:
    void take_over_command(double now_s) noexcept;
    void end_permission() noexcept;

    OperatorChannel& commands_;
    DeviceMapping mapping_;
    ArmModel arm_;
    HeldArm held_arm_;
    ToolPose wanted_;  // patient LPS
    ToolPose target_;  // on the way to wanted_
    TargetLimit limit_;
    Permission permission_;
    bool pedal_ = false;
    bool must_be_pressed_anew_ = false;
    std::optional<std::size_t> burr_;
    double read_at_s_ = 0.0;
};

}  // namespace osteomill
