// A way from the forces of a model's samples to the force of each haptic tick that is linear in the last few
// of them, with weights that repeat every model period:
//
//     u(tick j after sample n) = - sum_a weight[j][a] F_{n-a}
//
// Every method of the stability table is of this form, and so is each of them a few ticks late: what is held,
// how long, and how late is all in the weights.
#pragma once

#include <cstddef>
#include <vector>

namespace osteomill::study {

struct LinearHold {
    /// By tick after the model's sample, then by age of the force in model periods. Rows of one length.
    std::vector<std::vector<double>> weights;

    std::size_t ticks_per_sample() const { return weights.size(); }
    std::size_t forces_remembered() const { return weights.front().size(); }
};

/// The same weights throughout the model's period. Throws std::invalid_argument without a weight or a tick.
LinearHold held(const std::vector<double>& weights_by_age, std::size_t ticks_per_sample = 1);

/// Zero-order hold: F_n.
LinearHold zero_order_hold(std::size_t ticks_per_sample = 1);

/// F_{n-1}: the model takes a period to compute.
LinearHold one_sample_late(std::size_t ticks_per_sample = 1);

/// Straight from F_{n-1} to F_n over the period that follows sample n. The tick at which F_n arrives already
/// takes the first of the N strides, the last tick of the period gives F_n.
LinearHold interpolated(std::size_t ticks_per_sample);

/// Ellis, Sarkar, Jenkins (J. Dyn. Sys. Meas. Control 119:768, 1997), derived from the energy-exact trapezoid
/// and F_{n+1} = 2 F_n - F_{n-1}: 1.5 F_n - 0.5 F_{n-1}.
LinearHold sample_estimate_hold(std::size_t ticks_per_sample = 1);

/// The same, with what the previous estimate got wrong given back: 2 F_n - 1.5 F_{n-1} + 0.5 F_{n-2}.
LinearHold corrected_sample_estimate_hold(std::size_t ticks_per_sample = 1);

/// The same estimate when the newest force is one sample old: 2.5 F_{n-1} - 1.5 F_{n-2}.
LinearHold late_sample_estimate_hold(std::size_t ticks_per_sample = 1);

/// `hold` of forces that have each been estimated first: 1.5 F_n - 0.5 F_{n-1} at the model's rate.
LinearHold of_estimates(const LinearHold& hold);

/// The estimate taken from what `hold` gives, at the haptic rate: 1.5 times this tick's force, less half the
/// last's.
LinearHold then_estimated(const LinearHold& hold);

/// What `hold` gives, so many haptic ticks later.
LinearHold late_by_ticks(const LinearHold& hold, std::size_t ticks);

}  // namespace osteomill::study
