// A device that repeats, tick by tick, the readings of a recorded one. No hardware, no thread; deterministic.
#pragma once

#include <optional>

#include "common/scene/device_mapping.h"
#include "common/session/tick_sample.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

class RecordedDevice final : public HapticDevice {
  public:
    /// `limits`: the recorded arm's. `mapping`: the session's.
    RecordedDevice(const DeviceLimits& limits, const DeviceMapping& mapping)
        : limits_(limits), mapping_(mapping) {}

    /// Sets the next readings: the hand's pose and the input of a tick, which must have one. In a tick that
    /// places the tool the device is where it was.
    void say(const TickSample& tick) noexcept { tick_ = tick; }

    std::string name() const override { return "recorded hand"; }
    DeviceLimits limits() const override { return limits_; }
    void set_mapping(const DeviceMapping& mapping) noexcept override { mapping_ = mapping; }
    void start() override {}
    /// The velocity is the mean since the reading before.
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override {}

  private:
    DeviceLimits limits_;
    DeviceMapping mapping_;
    TickSample tick_{};
    std::optional<glm::dvec3> before_mm_{};  // device space, at the reading before
    double before_s_ = 0.0;
};

}  // namespace osteomill
