// Implicit coupling, the default: the burr is a proxy (burr_proxy.h) on a spring that the device can render,
// and the hand feels that spring and a little damping across it:
//
//     F_hand = -K_c e - B_c de/dt,   e = x_device - x_burr
//
// The steady force is the milling model's; hard bone becomes a wall, air nothing (there e = 0). The burr lags
// the hand by F / K_c, as a real handpiece yields.
#pragma once

#include "haptic_server/coupling/burr_proxy.h"
#include "haptic_server/coupling/coupling.h"
#include "haptic_server/coupling/position_observer.h"

namespace osteomill {

class ImplicitCoupling final : public Coupling {
  public:
    explicit ImplicitCoupling(const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override { placed_ = false; }

    /// Damping across the spring. More would buzz: one encoder count (0.055 mm) a millisecond is 55 mm/s.
    static constexpr double damping_n_s_per_mm = 0.002;
    /// Time constant of the first-order filter on de/dt, for the same reason.
    static constexpr double damping_filter_s = 0.003;

  private:
    double spring_n_per_mm_;
    PositionObserver hand_;
    BurrProxy proxy_;
    bool placed_ = false;
    glm::dvec3 lag_mm_{0.0};
    glm::dvec3 lag_rate_mm_per_s_{0.0};
};

}  // namespace osteomill
