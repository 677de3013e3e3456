#include "tests/studies/stability/sampled_force.h"

#include <algorithm>
#include <numeric>

namespace osteomill::study {

SampledForce::SampledForce(const ModelForce& model, const DelayedHold& hold, double tick_s)
    : model_(model),
      hold_(hold),
      period_s_(tick_s * static_cast<double>(hold.ticks_per_sample())),
      resistances_n_(hold.forces_remembered(), 0.0) {}

double SampledForce::operator()(double sensed_position_m) {
    if (tick_ == 0) {
        std::shift_right(resistances_n_.begin(), resistances_n_.end(), 1);
        resistances_n_.front() = model_.resistance_n(sensed_position_m, previous_sample_m_, period_s_);
        previous_sample_m_ = sensed_position_m;
    }
    const std::vector<double>& weights = hold_.weights[tick_];
    tick_ = (tick_ + 1) % hold_.ticks_per_sample();
    return -std::inner_product(weights.begin(), weights.end(), resistances_n_.begin(), 0.0);
}

}  // namespace osteomill::study
