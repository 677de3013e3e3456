// A haptic arm over USB HID as the loops see it. A thread of its own (hid_worker.h) talks to the arm
// (arm_link.h) at the pace of its reports; the haptic loop takes the newest reading and leaves the newest
// force, and waits for neither.
#pragma once

#include <functional>

#include "devices/arm_readings.h"
#include "devices/hid/arm_profile.h"
#include "devices/hid/hid_worker.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

class HidArm final : public HapticDevice {
  public:
    /// `clock_s` gives seconds that never decrease; the thread calls it and `on_thread_start`. The transport
    /// outlives the arm.
    HidArm(ArmProfile profile, HidTransport& transport, std::function<double()> clock_s,
           std::function<void()> on_thread_start);

    std::string name() const override { return profile_.name; }
    DeviceLimits limits() const override;
    void start() override { worker_.start(); }
    DeviceState read(double now_s) noexcept override { return readings_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override;
    void stop() noexcept override { worker_.stop(); }
    const char* notice() const noexcept override { return worker_.notice(); }

  private:
    ArmProfile profile_;
    ArmReadings readings_;             // thread to loop
    TripleBuffer<glm::dvec3> forces_;  // loop to thread
    HidWorker worker_;                 // last: its thread uses the others
};

/// The tip's position at the calibration position, device space.
glm::dvec3 home_position_mm(const ArmProfile& profile);

/// Whether a device is the arm of a profile.
bool is_arm_of(const HidIdentity& identity, const HidDeviceInfo& device);

}  // namespace osteomill
