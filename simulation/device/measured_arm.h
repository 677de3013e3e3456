// Figures of an arm as they were measured on it, with a hand on it (haptic_server --measure-arm). Device
// space.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace osteomill {

struct MeasuredArm {
    double calm_n_per_mm = 0.0;       ///< stiffest spring on which the arm came to rest after a tap
    double damping_n_s_per_mm = 0.0;  ///< the damper beside it, through ArmSpring::hand_filter_s
    double step_mm = 0.0;             ///< of a reading; 0: none was seen
    double noise_mm = 0.0;            ///< rms of what a reading jitters, of the worst axis
    std::optional<double> delay_s{};  ///< from a written force to its motion, beyond the tick that it takes
    std::optional<double> moving_mass_kg{};  ///< the least of the axes; the hand moves with it
    std::optional<double> friction_n{};      ///< Coulomb's, the least of the axes

    /// Standard deviations of noise that count as a step: within +-2 nothing is proven
    /// (position_observer.h). Up to half a step, noise is a reading that goes to and fro between two steps.
    static constexpr double noises_in_step = 4.0;
    double resolution_mm() const {
        const double beyond_mm2 = noise_mm * noise_mm - 0.25 * step_mm * step_mm;
        return std::max(step_mm, noises_in_step * std::sqrt(std::max(0.0, beyond_mm2)));
    }
};

}  // namespace osteomill
