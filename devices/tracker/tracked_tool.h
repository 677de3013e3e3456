// A handpiece seen by a tracker: the burr follows the hand, and no force goes back. Device space is the
// tracker's. The samples are played back by sampled_motion.h.
//
// A pedal sent as STRING messages is valid for Permission::by_message_s after each; so its sender repeats it.
// A press is delayed like the motion, or the burr would cut where the hand was before; a release acts at
// once. Without a pedal (one that is always down) visibility is the permission: the pedal counts as released
// for a moment when the tool reappears, since a spindle does not start by itself after a loss
// (safety/pedal_latch.h).
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "devices/tracker/sampled_motion.h"
#include "devices/tracker/tracker_file.h"
#include "devices/tracker/tracker_receiver.h"
#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"

namespace osteomill {

class TrackedTool final : public HapticDevice {
  public:
    /// How long a pedal that is always down is up when the tool has come back.
    static constexpr double released_s = 0.1;

    /// `start_pose` in device space: where it is reported to be before it was ever seen.
    TrackedTool(TrackerReceiver::Parts parts, TrackedHandpiece handpiece, const ToolPose& start_pose);

    std::string name() const override { return "tracked handpiece"; }
    /// The force is computed and shown, as large as an arm would give it.
    DeviceLimits limits() const override { return {.gives_force = false}; }
    void start() override { receiver_.start(); }
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override { receiver_.stop(); }
    const char* notice() const noexcept override;

  private:
    void take(const TrackerReceiver::Item& item, double now_s) noexcept;

    TrackedHandpiece handpiece_;
    std::function<double()> clock_s_;
    TrackerReceiver receiver_;
    SampledMotion motion_;
    std::atomic<SampledMotion::ClockFault> clock_fault_{SampledMotion::ClockFault::none};
    PedalStatement pedal_;
    bool was_there_ = false;
    double came_back_s_ = 0.0;
    DeviceState state_;
};

}  // namespace osteomill
