// The spindle's motor, whose speed falls under load. The fall is heard (docs/sound.md) and not felt: cut and
// force are computed as if the spindle kept its speed.
#pragma once

#include <algorithm>

namespace osteomill {

/// Full speed up to `steady_torque_n_mm`, as a motor with a regulator holds it; from there the speed falls
/// along a line to a stand at `stall_torque_n_mm`.
struct Motor {
    double stall_torque_n_mm = 0.0;   ///< above the other
    double steady_torque_n_mm = 0.0;  ///< 0: the speed falls from the first load on, as an air turbine's does

    bool operator==(const Motor&) const = default;
};

/// Speed under a load as a share of that in air, 1 to 0.
inline double speed_share_under(const Motor& motor, double torque_n_mm) noexcept {
    const double over_n_mm = torque_n_mm - motor.steady_torque_n_mm;
    return 1.0 - std::clamp(over_n_mm / (motor.stall_torque_n_mm - motor.steady_torque_n_mm), 0.0, 1.0);
}

}  // namespace osteomill
