// A simulated arm moved by an operator over the network: the mouse moves the hand's target, and hand and arm
// model follow it, so that the operator's tool yields to bone as an arm in a hand would.
//
// A command is valid for Permission::by_message_s after its arrival: without a fresh one the hand stands
// still, whatever the network's threads do, and so does the spindle (safety/pedal_latch.h). Targets are
// limited to a hand's motion (TargetLimit): one message moves the tool by longest_reach_mm at most.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "common/scene/scene.h"
#include "common/session/operator_command.h"
#include "devices/simulated/held_arm.h"
#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"
#include "simulation/exchange/operator_channel.h"

namespace osteomill {

/// Limits of a hand on targets that come by message: each within reach of the burr, and their path no longer
/// than a hand could have gone.
///
///     path since time 0  <=  room_mm + fastest_hand_mm_per_s * time,    room_mm = 2 longest_reach_mm
///
/// The margin allows messages that come late and in a burst: crossing the burr's reach from one side to the
/// other once is allowed.
class TargetLimit {
  public:
    static constexpr double room_mm = 2.0 * longest_reach_mm;

    /// The path begins at `start_mm` (device space, as all of these: a hand holds the arm).
    explicit TargetLimit(const glm::dvec3& start_mm) : target_mm_(start_mm) {}

    /// The path goes on from here: the operator was away.
    void resume_at(const glm::dvec3& target_mm) noexcept { target_mm_ = target_mm; }

    /// `wanted_mm` (finite), or the nearest allowed position. `now_s`: session time, never decreases.
    /// Real-time safe.
    glm::dvec3 limited(const glm::dvec3& wanted_mm, const glm::dvec3& burr_mm, double now_s) noexcept;

    /// The targets clamped so far, one line with static lifetime; empty if none. Any thread.
    const char* notice() const noexcept;

  private:
    glm::dvec3 target_mm_;
    double room_left_mm_ = room_mm;
    double limited_s_ = 0.0;
    std::atomic<bool> was_out_of_reach_{false};
    std::atomic<bool> was_too_fast_{false};
};

class ClientDevice final : public HapticDevice {
  public:
    /// Mouse positions come some 60 times a second: the target follows them with this time constant.
    static constexpr double target_filter_s = 0.04;

    /// A round trip, and a picture that is drawn slowly.
    static constexpr double unheard_s = 2.0;

    using Time = std::chrono::steady_clock::time_point;

    /// Reads `commands` as its only reader. The arm starts at rest at `start_pose` (patient LPS). Without an
    /// operator the hand holds its target. A command that is not finite is ignored. Targets are kept near the
    /// arm's tip, which is the burr except for the yield of the coupling. `clock` dates the commands.
    ClientDevice(
        OperatorChannel& commands, const ToolPose& start_pose, const DeviceMapping& mapping,
        const ArmModel& arm, const HandModel& hand,
        std::function<Time()> clock = [] { return std::chrono::steady_clock::now(); });

    std::string name() const override { return "operator over the network"; }
    DeviceLimits limits() const override { return limits_of(arm_); }
    void start() override {}
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override { held_arm_.set_motor_force(force_n); }
    void stop() noexcept override { held_arm_.set_motor_force(glm::dvec3(0.0)); }
    /// The hand stays where it is and holds still until the next command. A client that has not heard of it
    /// yet goes on with a target at the tool's old place, and would pull it back there: for unheard_s a
    /// target that is nearer to the last one before than to the new place is ignored.
    void set_mapping(const DeviceMapping& mapping) noexcept override;
    /// A notice of each kind of clamping, once.
    const char* notice() const noexcept override { return limit_.notice(); }

  private:
    void take_over_command(double now_s) noexcept;
    void end_permission() noexcept;
    bool is_of_old_place(const glm::dvec3& target_mm, double now_s) noexcept;

    OperatorChannel& commands_;
    DeviceMapping mapping_;
    ArmModel arm_;
    HeldArm held_arm_;
    ToolPose wanted_;  // patient LPS
    ToolPose target_;  // on the way to wanted_
    TargetLimit limit_;
    Permission permission_;
    PedalStatement pedal_;
    bool presses_next_ = false;  // the pedal came up and went down again between two reads: up in this one
    std::uint64_t heard_releases_ = 0;
    std::uint64_t heard_client_ = 0;
    std::function<Time()> clock_;
    std::optional<std::size_t> burr_;
    double read_at_s_ = 0.0;
    struct Moved {
        glm::dvec3 target_mm;  // wanted last before, patient LPS
        glm::dvec3 to_mm;      // patient LPS
        double at_s;
    };
    std::optional<Moved> moved_;  // while a client may not have heard of it
};

}  // namespace osteomill
