// A measurement of an arm from beginning to end: it is shaken (arm_shake.h), what moved is estimated, and a
// spring gets stiffer on it until it swings (stiffness_ramp.h).
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "haptic_server/measuring/arm_estimates.h"
#include "haptic_server/measuring/measuring_guard.h"
#include "simulation/device/haptic_device.h"
#include "simulation/device/measured_arm.h"

namespace osteomill {

struct ArmMeasurement {
    MeasuringEnd end = MeasuringEnd::none;  ///< none: it was stopped
    MeasuredArm arm;                        ///< its spring only if has_spring()
    std::array<std::optional<PushedMotion>, 3> axes{};
    double swinging_n_per_mm = 0.0;         ///< on this one it swung on; 0: on none that was tried
    std::vector<std::string> not_measured;  ///< a line for each, with its reason

    bool has_spring() const {
        return arm.calm_n_per_mm > 0.0 && (swinging_n_per_mm > 0.0 || end == MeasuringEnd::done);
    }
};

struct MeasuringContext {
    double delay_s = 0.001;         ///< as far as the arm's driver knows
    bool is_virtual = false;        ///< as fast as it can: for a simulated arm
    const std::atomic<bool>& stop;  ///< ends it with zero force
    /// Gets lines for people about what goes on; must not wait.
    std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// Starts the device, waits for its pedal, measures for some 20 s at 1 kHz, and stops it. The last force that
/// is written is zero, however it ends. Throws as HapticDevice::start.
ArmMeasurement measure_arm(HapticDevice& device, const MeasuringContext& context);

/// In words, for one without a spring.
std::string why_no_spring(const ArmMeasurement& found);

/// A table for people: what was measured, the spring that the arm gets (with_measured_spring), and a line for
/// each thing that could not be measured.
std::string text_of(const ArmMeasurement& found, const std::string& name, const DeviceLimits& stated,
                    double delay_s);

}  // namespace osteomill
