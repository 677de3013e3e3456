// Linear interpolation, as published: the burr is rigidly the device, the milling loop reports a mean force
// once a period, and each haptic tick renders the line from the force before to the newest one over the
// period that follows:
//
//     F(t) = F_{k-1} + (F_k - F_{k-1}) min(1, (t - t_k) / T),   t_k the tick at which F_k arrived
//
// At the published coefficients this cannot hold a light grip (reference: a sampled damper on a mass m is
// stable only below about 2 m / T); it is here to be compared. With the spindle off bone is the same wall as
// in every coupling: the proxy of burr_proxy.h on a spring that the device can render. Where the model holds
// the wall itself (CouplingOptions::model_holds_wall) its force is rendered alike with the spindle on and
// off.
#pragma once

#include <cstdint>

#include "haptic_server/coupling/burr_proxy.h"
#include "haptic_server/coupling/coupling.h"

namespace osteomill {

class InterpolatedCoupling final : public Coupling {
  public:
    explicit InterpolatedCoupling(const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override;

  private:
    double spring_n_per_mm_;
    double milling_period_s_;
    bool model_holds_wall_;
    BurrProxy wall_;
    bool wall_placed_ = false;
    std::uint64_t step_ = 0;    // of the newest force
    double arrival_s_ = 0.0;    // when it arrived
    glm::dvec3 before_n_{0.0};  // force rendered when it arrived
    glm::dvec3 newest_n_{0.0};
};

}  // namespace osteomill
