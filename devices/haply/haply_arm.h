// Haply's Inverse3 with a VerseGrip, as the loops see it; haply_link.h talks to it.
#pragma once

#include <functional>
#include <string>

#include "devices/haply/haply_link.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

class HaplyArm final : public HapticDevice {
  public:
    /// Begins to look for the service.
    explicit HaplyArm(HaplyLinkParts parts) : link_(std::move(parts)) {}

    /// Waits until the arm is there and the delay to it has been measured; false if `gives_up` ends the wait.
    bool await(const std::function<bool()>& gives_up);

    /// Delay from a reading to the force that answers it: the round trip to the service, and the loop's tick.
    double delay_s() const { return 0.001 + link_.round_trip_s().value_or(0.0); }
    /// Device space.
    glm::dvec3 workspace_middle_mm() const;

    std::string name() const override { return "Haply Inverse3"; }
    /// With the stiffness that is stable at the measured delay.
    DeviceLimits limits() const override;
    void start() override {}
    DeviceState read(double now_s) noexcept override { return link_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override { link_.write(force_n); }
    void stop() noexcept override { link_.stop(); }
    const char* notice() const noexcept override { return link_.notice(); }

  private:
    HaplyLink link_;
};

}  // namespace osteomill
