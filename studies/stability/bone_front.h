// Bone in one dimension that a burr has cut up to a front: what it resists with is in proportion to how fast
// the front advances, and it gives nothing to a burr that draws back or returns to where it has been.
//
//     F_n = B max(0, x_n - front) / (N T)        front = the farthest x so far
//
// A milling force's damper without its sideways part; the damper of model_force.h resists both ways.
#pragma once

#include <algorithm>

namespace osteomill::study {

class BoneFront {
  public:
    explicit BoneFront(double cutting_n_s_per_m) : cutting_n_s_per_m_(cutting_n_s_per_m) {}

    /// Cuts to where the burr is, `period_s` after the last cut. The bone begins at the origin.
    double operator()(double position_m, double period_s) {
        const double advance_m = std::max(0.0, position_m - front_m_);
        front_m_ += advance_m;
        return cutting_n_s_per_m_ * advance_m / period_s;
    }

  private:
    double cutting_n_s_per_m_;
    double front_m_ = 0.0;
};

}  // namespace osteomill::study
