// The boundary to haptic hardware: a life cycle of a few calls, in device space. Simulated, client-driven
// and real devices implement it alike, in devices; the haptic loop (simulation/loop/haptic_loop.h)
// reads and writes it.
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

#include "common/scene/device_mapping.h"
#include "common/scene/scene.h"

namespace osteomill {

// Limits of an arm's abilities, in its own space and in the patient's: two types, so that one is not confused
// with the other. device_mapping.h says how a figure converts.

/// In the device's millimetres.
struct DeviceLimits {
    double max_force_n = 3.3;
    double max_stiffness_n_per_mm = 1.5;  ///< stiffest spring that it renders stably
    double apparent_mass_kg = 0.045;
    double position_resolution_mm = 0.0;       ///< step of a position reading; 0: negligible
    double damping_n_s_per_mm = 0.004;         ///< the damper beside that spring
    const char* stiffness_is_limited_by = "";  ///< for people
    bool gives_force = true;                   ///< false: forces are shown to people, and felt by nobody
};

/// The same in the patient's millimetres, in which couplings reckon.
struct PatientLimits {
    double max_force_n = DeviceLimits{}.max_force_n;
    double max_stiffness_n_per_mm = DeviceLimits{}.max_stiffness_n_per_mm;
    double apparent_mass_kg = DeviceLimits{}.apparent_mass_kg;
    double position_resolution_mm = DeviceLimits{}.position_resolution_mm;
    double damping_n_s_per_mm = DeviceLimits{}.damping_n_s_per_mm;
    ArmScale scale{};  ///< for a coupling's own demands on the arm
};

constexpr PatientLimits in_patient_space(const DeviceLimits& arm, ArmScale scale) {
    return {.max_force_n = arm.max_force_n,
            .max_stiffness_n_per_mm = scale.stiffness_n_per_mm(arm.max_stiffness_n_per_mm),
            .apparent_mass_kg = scale.mass_kg(arm.apparent_mass_kg),
            .position_resolution_mm = scale.length_mm(arm.position_resolution_mm),
            .damping_n_s_per_mm = scale.damping_n_s_per_mm(arm.damping_n_s_per_mm),
            .scale = scale};
}

/// A device's report of its pedal, and the time of the report. The loop's latch (safety/pedal_latch.h)
/// decides the pedal's permission. A device only reports the pedal's state, never holds a pedal down or up by
/// itself, and lets the report grow old while it knows nothing.
struct PedalStatement {
    bool is_down = false;
    /// Session time; by default never. No later than the pedal was reported: a report from a queue is as old
    /// as the last check that found the queue empty.
    double said_s = -std::numeric_limits<double>::infinity();
    std::uint64_t speaker = 0;  ///< changes with the arm, client or connection that reports
    double acts_after_s = 0.0;  ///< delay of a press: for motions that are played back late
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

    /// Opens the device. Throws std::runtime_error with one line about the missing part and the remedy.
    virtual void start() = 0;

    /// Newest state at session time `now_s` (seconds since the session began; never decreases). Real-time
    /// safe. A simulated device integrates its motion up to `now_s` under the force last written.
    virtual DeviceState read(double now_s) noexcept = 0;

    /// Force on the hand from now on, device space. Real-time safe. The caller has clamped and slew-limited
    /// it.
    virtual void write(const glm::dvec3& force_n) noexcept = 0;

    /// Force off, device closed. Safe in any state.
    virtual void stop() noexcept = 0;

    /// Places the device on the patient from now on. Real-time safe, from the thread of read(). For devices
    /// that know the patient's position; all others ignore it.
    virtual void set_mapping(const DeviceMapping&) noexcept {}

    /// A notice for people about the device, in one line with static lifetime; empty while all is well. Any
    /// thread.
    virtual const char* notice() const noexcept { return ""; }
};

}  // namespace osteomill
