#include "devices/simulated/simulated_device.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "common/scene/device_mapping.h"

namespace osteomill {

namespace {

/// A tick's time is a sum of milliseconds, a file's is rounded: a waypoint due at a tick has been reached by
/// then.
constexpr double rounding_s = 1e-6;

}  // namespace

SimulatedDevice::SimulatedDevice(Trajectory trajectory, const DeviceMapping& mapping, const ArmModel& arm,
                                 const HandModel& hand)
    : trajectory_(std::move(trajectory)),
      mapping_(mapping),
      arm_(arm),
      held_arm_(arm, hand, position_in_device_mm(mapping, trajectory_.at(0.0).target.position_mm)) {}

SimulatedDevice::SimulatedDevice(Trajectory trajectory, const DeviceMapping& mapping, const DeviceLimits& arm)
    : SimulatedDevice(std::move(trajectory), mapping, ArmModel{}, hand_model(Grip::firm)) {
    rails_.emplace(trajectory_.at(0.0).target, mapping, arm);
}

double SimulatedDevice::pace(const glm::dvec3& target_in_device_mm) const noexcept {
    const double away_mm = glm::distance(target_in_device_mm, held_arm_.truth().position_mm());
    return std::clamp((slowest_pace_from_mm - away_mm) / (slowest_pace_from_mm - full_pace_within_mm),
                      slowest_pace, 1.0);
}

DeviceState SimulatedDevice::read(double now_s) noexcept {
    if (rails_) return read_on_rails(now_s);
    const ToolPose before = trajectory_.at(trajectory_time_s_).target;
    trajectory_time_s_ += (now_s - read_at_s_) * pace(position_in_device_mm(mapping_, before.position_mm));
    read_at_s_ = now_s;
    if (trajectory_time_s_ >= trajectory_.duration_s()) is_finished_.store(true, std::memory_order_relaxed);

    const TrajectorySample sample = trajectory_.at(trajectory_time_s_);
    const glm::dvec3 axis_in_device = direction_in_device(mapping_, sample.target.spindle_axis);
    held_arm_.advance(now_s, position_in_device_mm(mapping_, sample.target.position_mm), axis_in_device);
    return {.position_mm = held_arm_.sensor().position_mm(),
            .velocity_mm_per_s = held_arm_.sensor().velocity_mm_per_s(),
            .spindle_axis = axis_in_device,
            .pedal = {.is_down = now_s > 0.0 && sample.pedal, .said_s = now_s},
            .burr = sample.burr};
}

DeviceState SimulatedDevice::read_on_rails(double now_s) noexcept {
    trajectory_time_s_ = now_s;
    if (trajectory_time_s_ + rounding_s >= trajectory_.duration_s())
        is_finished_.store(true, std::memory_order_relaxed);
    const TrajectorySample sample = trajectory_.at(trajectory_time_s_, rounding_s);
    rails_->move_to(sample.target);
    rails_->press(now_s > 0.0 && sample.pedal);
    if (sample.burr) rails_->take_burr(*sample.burr);
    return rails_->read(now_s);
}

}  // namespace osteomill
