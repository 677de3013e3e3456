// A haptic arm in a hand that follows a trajectory; no hardware. Deterministic: what it reads depends on the
// trajectory, the forces written and the times of reading, and on nothing else.
//
// The hand waits for its tool. If hard bone holds the burr back, a person does not aim centimetres ahead of
// it, but feeds more slowly: trajectory time passes at a pace that falls with the distance e between target
// and tool,
//
//     d(trajectory time)/dt = clamp((e_slowest - e) / (e_slowest - e_full), slowest_pace, 1)
#pragma once

#include "common/scene/scene.h"
#include "devices/simulated/held_arm.h"
#include "devices/simulated/prescribed_device.h"
#include "devices/simulated/trajectory.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/copiable_atomic.h"

namespace osteomill {

class SimulatedDevice final : public HapticDevice {
  public:
    /// A hand keeps its line to about a millimetre without slowing down, and does not push on if the tool is
    /// three away.
    static constexpr double full_pace_within_mm = 1.0;
    static constexpr double slowest_pace_from_mm = 3.0;
    /// Never zero, so that every trajectory ends: against a wall after twenty times its duration.
    static constexpr double slowest_pace = 0.05;

    /// The trajectory is in patient space; `mapping` takes it to device space. The arm starts at rest where
    /// the trajectory begins.
    SimulatedDevice(Trajectory trajectory, const DeviceMapping& mapping, const ArmModel& arm,
                    const HandModel& hand);
    /// An arm on rails: always exactly on the trajectory, whatever the force, as the recorded arm was.
    SimulatedDevice(Trajectory trajectory, const DeviceMapping& mapping, const DeviceLimits& arm);

    std::string name() const override { return "simulated arm"; }
    DeviceLimits limits() const override { return rails_ ? rails_->limits() : limits_of(arm_); }
    void start() override {}
    /// The script's pedal is up before the session: at time 0.
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3& force_n) noexcept override { held_arm_.set_motor_force(force_n); }
    void stop() noexcept override { held_arm_.set_motor_force(glm::dvec3(0.0)); }

    /// Whether the trajectory has been followed to its end. Any thread.
    bool is_finished() const noexcept { return is_finished_.load(std::memory_order_relaxed); }

    /// Share of the trajectory that has been followed, 0 to 1; 0 for one that never ends. Only from the
    /// thread that reads.
    double done() const noexcept { return trajectory_time_s_ / duration_s(); }
    /// Duration of the trajectory at full pace; infinite for one that never ends.
    double duration_s() const noexcept { return trajectory_.duration_s(); }

    const HeldArm& held_arm() const { return held_arm_; }

  private:
    double pace(const glm::dvec3& target_in_device_mm) const noexcept;
    DeviceState read_on_rails(double now_s) noexcept;

    Trajectory trajectory_;
    DeviceMapping mapping_;
    ArmModel arm_;
    HeldArm held_arm_;
    std::optional<PrescribedDevice> rails_{};
    double read_at_s_ = 0.0;
    double trajectory_time_s_ = 0.0;
    CopiableAtomic<bool> is_finished_{false};
};

}  // namespace osteomill
