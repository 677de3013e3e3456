// The boundary to haptic hardware: a life cycle of a few calls, in device space. Simulated, client-driven,
// faulty and real devices implement it alike.
//
//   constructed --start()--> running --stop()--> stopped
//                               |
//                               +-- lost: read() says connected = false; writes are ignored
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>

#include "common/scene/scene.h"
#include "simulation/device/device_limits.h"

namespace osteomill {

/// What a device says of its pedal, and when that was said. It is worth what the loop's latch makes of it
/// (safety/pedal_latch.h): a device states what it knows, keeps no pedal down or up by itself, and where it
/// knows nothing lets the statement grow old.
struct PedalStatement {
    bool is_down = false;
    /// Session time; by default never. No later than it was said: what came through a queue is as old as the
    /// last look that found the queue empty.
    double said_s = -std::numeric_limits<double>::infinity();
    std::uint64_t speaker = 0;  ///< another number where another arm, client or connection says it
    double acts_after_s = 0.0;  ///< a press counts so much later: of motions that are played back late
};

/// One reading, in device space.
struct DeviceState {
    glm::dvec3 position_mm{0.0};
    glm::dvec3 velocity_mm_per_s{0.0};       ///< the driver's own estimate
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit vector from tip to shank
    PedalStatement pedal{};
    std::optional<std::size_t> burr{};  ///< asks for another burr of the scene's set
    bool connected = true;
};

class HapticDevice {
  public:
    virtual ~HapticDevice() = default;

    virtual std::string name() const = 0;
    virtual DeviceLimits limits() const = 0;

    /// Opens the device. Throws std::runtime_error with one line that says what is missing and what would
    /// help.
    virtual void start() = 0;

    /// Newest state at session time `now_s` (seconds since the session began; never decreases). Real-time
    /// safe. A simulated device integrates its motion up to `now_s` under the force last written.
    virtual DeviceState read(double now_s) noexcept = 0;

    /// Force on the hand from now on, device space. Real-time safe. The caller has clamped and slew-limited
    /// it.
    virtual void write(const glm::dvec3& force_n) noexcept = 0;

    /// Force off, device closed. Safe in any state.
    virtual void stop() noexcept = 0;

    /// From now on the device sits so on the patient. Real-time safe, from the thread of read(). For devices
    /// that know where the patient is; for others it is no matter.
    virtual void set_mapping(const DeviceMapping&) noexcept {}

    /// What people should know or do about the device, in one line that lives for ever; empty while all is
    /// well. Any thread.
    virtual const char* notice() const noexcept { return ""; }
};

}  // namespace osteomill
