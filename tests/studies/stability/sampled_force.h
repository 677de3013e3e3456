// A model's force and the way it is held, run tick by tick: what a program would do at the haptic rate.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/studies/stability/delayed_hold.h"
#include "tests/studies/stability/model_force.h"

namespace osteomill::study {

class SampledForce {
  public:
    /// At rest at the origin until the first tick.
    SampledForce(const ModelForce& model, const DelayedHold& hold, double tick_s);

    /// The force on the device from this tick to the next. The model samples at the first tick and then every
    /// `ticks_per_sample`.
    double operator()(double sensed_position_m);

  private:
    ModelForce model_;
    DelayedHold hold_;
    double period_s_;
    std::size_t tick_ = 0;  ///< since the model's sample
    double previous_sample_m_ = 0.0;
    std::vector<double> resistances_n_;  ///< by age
};

}  // namespace osteomill::study
