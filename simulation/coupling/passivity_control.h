// Passivity observer and controller around another coupling, in the time domain (Hannaford and Ryu, IEEE
// Trans. Robotics and Automation 18:1, 2002): it watches the energy that the rendered force has taken from
// the hand, and damps for as long as the force has given more than it took.
//
//     W_k  = W_{k-1} - F_{k-1} . s_k                      s_k = x_k - x_{k-1}
//     F_k  = F_base - alpha s_k / T   where W_k < 0, with
//     alpha = min(-W_k T / |s_k|^2, m / (2 T))            pays W_k back over the next step, if it is as long
//
// The held force is paired with the displacement over which it acted: the usual product of a force and a
// backward-difference velocity never sees the energy that a hold leaks. The controller's own force is part of
// the account, so an unpaid debt stays. The bound keeps it a damper that is stable on a sampled arm of
// apparent mass m, even one tick late.
//
// When contact ends, credit is forgotten, as in the paper, so that energy taken in one contact does not hide
// energy given in the next; a debt is kept. Within a long contact that dissipates (a cut) the observer may
// still hold much credit when chatter begins: the method's known weakness, not mended here.
//
// Positions come through the observer of position_observer.h: whole encoder counts would be paid in blows.
#pragma once

#include <memory>

#include "simulation/coupling/coupling.h"
#include "simulation/coupling/position_observer.h"

namespace osteomill {

class PassivityControl final : public Coupling {
  public:
    PassivityControl(std::unique_ptr<Coupling> base, const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override;
    PassivityControl(const PassivityControl& other);
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<PassivityControl>(*this); }

    /// Energy taken from the hand in this contact, mJ; negative: given.
    double taken_mj() const noexcept { return taken_mj_; }

  private:
    std::unique_ptr<Coupling> base_;
    PositionObserver position_;
    double apparent_mass_kg_;
    bool has_last_ = false;
    glm::dvec3 last_position_mm_{0.0};
    glm::dvec3 last_force_n_{0.0};
    double taken_mj_ = 0.0;
};

}  // namespace osteomill
