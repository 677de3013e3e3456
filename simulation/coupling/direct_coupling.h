// Direct coupling: the burr is rigidly the device, and the hand feels the model's force, reconstructed
// between its samples (force_reconstruction.h).
//
// In the loop as it runs, the force for the pose of tick k is visible at tick k + 1 at the earliest.
//
// At the published coefficients cutting is, toward the hand, a damper of hundreds of N s/m, and a sampled
// damper on a mass m is stable only below about 2 m / T: none of these can hold every cut. They are here to
// be compared.
//
// With the spindle off bone is a wall: a proxy stays on the surface (burr_proxy.h), and a spring as stiff as
// the device claims to render pulls the hand to it. The proxy moves at every tick. The spring's force is
// sampled with the model's results and rendered by the same reconstruction, so the known limits of sampled
// walls (hold: K < 2 b / T) apply to each. A force model that holds the wall itself
// (CouplingOptions::model_holds_wall) is rendered alike with the spindle on and off.
#pragma once

#include <cstdint>

#include "simulation/coupling/burr_proxy.h"
#include "simulation/coupling/coupling.h"
#include "simulation/coupling/force_reconstruction.h"

namespace osteomill {

class DirectCoupling final : public Coupling {
  public:
    DirectCoupling(ForceEstimate estimate, ForceShape shape, const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override;
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<DirectCoupling>(*this); }

  private:
    /// The place that the wall leaves to the burr.
    const glm::dvec3& follow_wall(const HandState& hand, const MillingResult& latest) noexcept;

    double wall_n_per_mm_;
    bool model_holds_wall_;
    ForceReconstruction force_;
    std::uint64_t step_ = 0;  // of the newest sample
    BurrProxy wall_;
    bool is_wall_placed_ = false;
};

}  // namespace osteomill
