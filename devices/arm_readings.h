// Readings of an arm whose driver has a thread of its own: the newest crosses to the haptic loop
// (simulation/loop/haptic_loop.h), and is valid while it is fresh.
#pragma once

#include <functional>

#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

/// The state that the driver's thread knows.
struct ArmReading {
    DeviceState state{.connected = false};  ///< with a pedal of no date
    bool knows_pedal = false;               ///< false: nothing is known of it
    double said_s = 0.0;                    ///< by the arm's clock: no later than the reading was true
};

class ArmReadings {
  public:
    /// Session time without a new reading after which the arm counts as lost, whatever its thread does.
    static constexpr double longest_age_s = 0.03;

    /// `clock_s`: the arm's, seconds that never decrease; the loop asks it.
    explicit ArmReadings(std::function<double()> clock_s) : clock_s_(std::move(clock_s)) {}

    /// The thread's. Real-time safe.
    void publish(const ArmReading& reading) noexcept {
        readings_.back() = reading;
        readings_.publish();
    }

    /// The loop's, as HapticDevice::read. Real-time safe.
    DeviceState read(double now_s) noexcept {
        const bool is_new = readings_.refresh();
        const ArmReading& newest = readings_.front();
        if (is_new) permission_.renew(said_at(now_s, clock_s_() - newest.said_s));
        DeviceState state = newest.state;
        if (newest.knows_pedal)
            state.pedal.said_s = permission_.renewed_s();
        else
            state.pedal = {};
        state.connected = state.connected && permission_.holds(now_s);
        return state;
    }

  private:
    std::function<double()> clock_s_;
    TripleBuffer<ArmReading> readings_;
    Permission permission_{longest_age_s};
};

}  // namespace osteomill
