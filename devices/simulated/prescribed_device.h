// Devices whose hand does as it is told, whatever the force on it: a prescribed pose, or the readings of a
// recording. No hardware, no thread; deterministic.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/scene/device_mapping.h"
#include "common/scene/scene.h"
#include "common/session/tick_sample.h"
#include "common/session/written_pose.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

/// A device whose hand is at a prescribed pose, whatever the force on it: for sessions that are stepped from
/// outside. No hardware, no thread; deterministic.
class PrescribedDevice final : public HapticDevice {
  public:
    /// Patient space. Until it is moved the hand rests at `start`, with the pedal up.
    PrescribedDevice(const ToolPose& start, const DeviceMapping& mapping, const DeviceLimits& limits = {});

    /// Places the hand from the next reading on. Patient space; `axis` is a unit vector. Call between two
    /// readings, from the thread that advances the session. The pose is rounded as the loop rounds it, and so
    /// is the velocity.
    void move_to(const ToolPose& hand) noexcept { hand_ = as_written(hand); }
    void press(bool pedal) noexcept { pedal_ = pedal; }
    /// Number in the scene's set, from 0.
    void take_burr(std::size_t burr) noexcept { burr_ = burr; }

    std::string name() const override { return "prescribed hand"; }
    /// The limits of an ideal arm (DeviceLimits), unless others were given.
    DeviceLimits limits() const override { return limits_; }
    void start() override {}
    /// The velocity is the mean since the reading before.
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override {}
    void set_mapping(const DeviceMapping& mapping) noexcept override { mapping_ = mapping; }

  private:
    DeviceMapping mapping_;
    DeviceLimits limits_;
    ToolPose hand_;
    bool pedal_ = false;
    std::optional<std::size_t> burr_{};
    std::optional<glm::dvec3> before_mm_{};  // device space, at the reading before
    double before_s_ = 0.0;
};

/// A device that repeats, tick by tick, the readings of a recorded one. No hardware, no thread;
/// deterministic.
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
