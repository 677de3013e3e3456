// An arm on rails: it is where the trajectory says, whatever force is written to it. What a contact model
// does along a given way, with nobody's hand in between.
#pragma once

#include <atomic>
#include <limits>
#include <string>
#include <utility>

#include "devices/simulated/trajectory.h"
#include "simulation/device/haptic_device.h"

namespace osteomill::study {

class GuidedDevice final : public HapticDevice {
  public:
    /// Device space is taken to be patient space.
    explicit GuidedDevice(Trajectory trajectory) : trajectory_(std::move(trajectory)) {}

    std::string name() const override { return "arm on rails"; }
    /// Of any force.
    DeviceLimits limits() const override { return {.max_force_n = std::numeric_limits<double>::max()}; }
    void start() override {}
    DeviceState read(double now_s) noexcept override {
        if (now_s >= trajectory_.duration_s()) is_finished_.store(true, std::memory_order_relaxed);
        const TrajectorySample sample = trajectory_.at(now_s);
        return {.position_mm = sample.target.position_mm,
                .spindle_axis = sample.target.spindle_axis,
                .pedal = {.is_down = now_s > 0.0 && sample.pedal, .said_s = now_s},
                .burr = sample.burr};
    }
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override {}

    bool is_finished() const noexcept { return is_finished_.load(std::memory_order_relaxed); }

  private:
    Trajectory trajectory_;
    std::atomic<bool> is_finished_{false};
};

}  // namespace osteomill::study
