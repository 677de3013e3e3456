// A model's force and the way it is held, run tick by tick: what a program would do at the haptic rate.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "studies/stability/linear_hold.h"
#include "studies/stability/model_force.h"

namespace osteomill::study {

/// What a model resists with, newtons, at a sample `period_s` after the one before. May remember.
using Resistance = std::function<double(double position_m, double period_s)>;

/// At rest at the origin before the first sample.
Resistance resistance_of(const ModelForce& model);

class SampledForce {
  public:
    /// Nothing resists before the first sample.
    SampledForce(Resistance resistance, const LinearHold& hold, double tick_s);
    SampledForce(const ModelForce& model, const LinearHold& hold, double tick_s)
        : SampledForce(resistance_of(model), hold, tick_s) {}

    /// The force on the device from this tick to the next. The model samples at the first tick and then every
    /// `ticks_per_sample`.
    double operator()(double sensed_position_m);

  private:
    Resistance resistance_;
    LinearHold hold_;
    double period_s_;
    std::size_t tick_ = 0;               ///< since the model's sample
    std::vector<double> resistances_n_;  ///< by age
};

}  // namespace osteomill::study
