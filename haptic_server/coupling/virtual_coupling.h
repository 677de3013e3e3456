// Virtual coupling (Colgate, Stanley and Brown, IROS 1995): a virtual tool with a mass, integrated at the
// haptic rate under the model's held force, tied to the hand by a spring and a damper. The hand feels the
// tie, the burr is the tool.
//
//     w' = w + T/M (F_model + F_tie)      F_tie = K_c e + B_c de/dt, e = x_hand - p (coupling_spring.h)
//     p' = p + T w'                       F_hand = -F_tie
//
// What the model does at the tool, the hand meets only through a tie that the device can render. But the tool
// meets the model's force as the device would, held and late: bone that resists like a damper of B needs
// B < about 2 M / T, and the tool is a mass that is felt in air. M is the device's own apparent mass, which
// the hand moves anyway: the price in air is twice the inertia, and above about 90 N s/m the tool chatters.
//
// Bone is met as in direct_coupling.h, `hold`, with the tool in the device's place: with the spindle off, a
// sampled wall.
#pragma once

#include "haptic_server/coupling/coupling.h"
#include "haptic_server/coupling/coupling_spring.h"
#include "haptic_server/coupling/direct_coupling.h"
#include "haptic_server/coupling/position_observer.h"

namespace osteomill {

class VirtualCoupling final : public Coupling {
  public:
    explicit VirtualCoupling(const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override;

  private:
    double tool_mass_kg_;
    PositionObserver hand_;
    CouplingSpring tie_;
    DirectCoupling bone_;
    bool placed_ = false;
    glm::dvec3 tool_mm_{0.0};
    glm::dvec3 tool_mm_per_s_{0.0};
};

}  // namespace osteomill
