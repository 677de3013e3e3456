// Readings of an arm whose driver has a thread of its own: the newest crosses to the haptic loop, and is
// valid while it is fresh.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

/// Where the tool is and what the arm's buttons say. Device space.
struct ArmReading {
    glm::dvec3 tool_mm{0.0};
    glm::dvec3 velocity_mm_per_s{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};
    bool pedal = false;
    bool knows_pedal = false;  ///< false: nothing is known of it
    /// Changes with the arm, grip or connection that reports the pedal.
    std::uint64_t speaker = 0;
    std::size_t burr = 0;
    bool is_ready = false;                         ///< the arm is there, and the other members are current
    std::chrono::steady_clock::time_point said{};  ///< no later than the reading was true
};

class ArmReadings {
  public:
    /// Session time without a new reading after which the arm counts as lost.
    static constexpr double longest_age_s = 0.03;

    /// The thread's. Real-time safe.
    void publish(const ArmReading& reading) noexcept {
        readings_.back() = reading;
        readings_.publish();
    }

    /// The loop's, as HapticDevice::read. Real-time safe.
    DeviceState read(double now_s) noexcept {
        const bool is_new = readings_.refresh();
        const ArmReading& newest = readings_.front();
        if (is_new)
            permission_.renew(said_at(
                now_s,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - newest.said).count()));
        return {.position_mm = newest.tool_mm,
                .velocity_mm_per_s = newest.velocity_mm_per_s,
                .spindle_axis = newest.spindle_axis,
                .pedal = newest.knows_pedal ? PedalStatement{.is_down = newest.pedal,
                                                             .said_s = permission_.renewed_s(),
                                                             .speaker = newest.speaker}
                                            : PedalStatement{},
                .burr = newest.burr,
                .connected = permission_.holds(now_s) && newest.is_ready};
    }

  private:
    TripleBuffer<ArmReading> readings_;
    Permission permission_{longest_age_s};
};

}  // namespace osteomill
