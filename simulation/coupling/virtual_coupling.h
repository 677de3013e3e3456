// Virtual coupling (Colgate, Stanley and Brown, IROS 1995): a virtual tool with a mass, met by the bone and
// tied to the hand by a spring and a damper. The hand feels the tie, the burr is the tool.
//
//     M (w' - w) / T = F_tie(w' T) + F_bone(w' T)     F_tie = K_c e + B_c de/dt, e = x_hand - p
//     p' = p + T w'                                   F_hand = -F_tie      (coupling_spring.h)
//
// Solved at the tick's end, on the engagement map (burr_proxy.h): the mass is one more pull that grows with
// the tool's step, M / T^2 for each mm. So bone may resist as strongly as it likes. If it were advanced with
// a force that is held and a tick late, the tool would chatter above about 90 N s/m.
//
// M is the device's own apparent mass, which the hand moves anyway: the price in air is twice the inertia.
//
// A model without a cutting law (CouplingOptions::model_holds_wall) has no map: its newest force is held.
#pragma once

#include "simulation/coupling/burr_proxy.h"
#include "simulation/coupling/coupling.h"
#include "simulation/coupling/coupling_spring.h"
#include "simulation/coupling/fixture_pull.h"
#include "simulation/coupling/position_observer.h"

namespace osteomill {

class VirtualCoupling final : public Coupling {
  public:
    explicit VirtualCoupling(const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override {
        placed_ = false;
        fixtures_.reset();
    }
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<VirtualCoupling>(*this); }
    SolveCounts solve_counts() const noexcept override { return tool_.counts(); }
    FeltFixtures felt_fixtures() const noexcept override { return fixtures_.felt(); }

  private:
    double mass_n_s2_per_mm_;
    bool model_holds_wall_;
    PositionObserver hand_;
    CouplingSpring tie_;
    BurrProxy tool_;
    FixturePull fixtures_;
    bool placed_ = false;
    glm::dvec3 velocity_mm_per_s_{0.0};  // of the tool
};

}  // namespace osteomill
