// The energy that a held force takes from the device: each force with the displacement that it acted over.
//
//     taken = - sum_n u_n (x_{n+1} - x_n)
//
// u_n was set at tick n and held until tick n + 1. An observer that multiplies force and backward-difference
// velocity pairs u_n with the displacement before it, x_n - x_{n-1}, and never sees the excess energy that a
// hold gives back.
#pragma once

namespace osteomill::study {

class EnergyLedger {
  public:
    void held(double force_n, double displacement_m) { taken_j_ -= force_n * displacement_m; }

    /// Negative: the force gave more than it took.
    double taken_j() const { return taken_j_; }

  private:
    double taken_j_ = 0.0;
};

}  // namespace osteomill::study
