#include "haptic_server/device/simulated_device.h"

#include <utility>

#include "common/scene/device_mapping.h"

namespace osteomill {

SimulatedDevice::SimulatedDevice(Trajectory trajectory, const DeviceMapping& mapping, const ArmModel& arm,
                                 const HandModel& hand)
    : trajectory_(std::move(trajectory)),
      mapping_(mapping),
      arm_(arm),
      held_arm_(arm, hand, position_in_device_mm(mapping, trajectory_.at(0.0).target.position_mm)) {}

DeviceState SimulatedDevice::read(double now_s) noexcept {
    const TrajectorySample sample = trajectory_.at(now_s);
    held_arm_.advance(now_s, position_in_device_mm(mapping_, sample.target.position_mm));
    return {.position_mm = held_arm_.sensor().position_mm(),
            .velocity_mm_per_s = held_arm_.sensor().velocity_mm_per_s(),
            .spindle_axis = direction_in_device(mapping_, sample.target.spindle_axis),
            .pedal = sample.pedal,
            .burr = sample.burr};
}

}  // namespace osteomill
