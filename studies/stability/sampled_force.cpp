#include "studies/stability/sampled_force.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace osteomill::study {

Resistance resistance_of(const ModelForce& model) {
    return [model, previous_m = 0.0](double position_m, double period_s) mutable {
        return model.resistance_n(position_m, std::exchange(previous_m, position_m), period_s);
    };
}

SampledForce::SampledForce(Resistance resistance, const LinearHold& hold, double tick_s)
    : resistance_(std::move(resistance)),
      hold_(hold),
      period_s_(tick_s * static_cast<double>(hold.ticks_per_sample())),
      resistances_n_(hold.forces_remembered(), 0.0) {}

double SampledForce::operator()(double sensed_position_m) {
    if (tick_ == 0) {
        std::shift_right(resistances_n_.begin(), resistances_n_.end(), 1);
        resistances_n_.front() = resistance_(sensed_position_m, period_s_);
    }
    const std::vector<double>& weights = hold_.weights[tick_];
    tick_ = (tick_ + 1) % hold_.ticks_per_sample();
    return -std::inner_product(weights.begin(), weights.end(), resistances_n_.begin(), 0.0);
}

}  // namespace osteomill::study
