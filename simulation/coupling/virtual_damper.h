// Virtual damper beside another coupling, felt in contact only: air stays free.
//
//     F = F_base - B min(1, |F_base| / F_full) v          v of the device, as its driver estimates it
//
// It makes up for the energy that a hold returns (a wall of stiffness K: K T / 2). It does not help a force
// that is a damper already: that only becomes a stronger sampled damper. The damping grows with the contact
// force up to F_full, so that touching bone at speed is not a jump.
#pragma once

#include <memory>

#include "simulation/coupling/coupling.h"

namespace osteomill {

class VirtualDamper final : public Coupling {
  public:
    /// 5 N s/m. More would buzz: one encoder count (0.055 mm) a millisecond is 55 mm/s, 9 mm/s after a
    /// driver's filter of 5 ms.
    static constexpr double damping_n_s_per_mm = 0.005;  // at the arm
    static constexpr double full_at_n = 0.2;

    VirtualDamper(std::unique_ptr<Coupling> base, const CouplingOptions& options)
        : base_(std::move(base)),
          damping_n_s_per_mm_(options.device.scale.damping_n_s_per_mm(damping_n_s_per_mm)) {}

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override { base_->reset(); }
    VirtualDamper(const VirtualDamper& other)
        : base_(other.base_->copy()), damping_n_s_per_mm_(other.damping_n_s_per_mm_) {}
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<VirtualDamper>(*this); }

  private:
    std::unique_ptr<Coupling> base_;
    double damping_n_s_per_mm_;  // in patient space
};

}  // namespace osteomill
