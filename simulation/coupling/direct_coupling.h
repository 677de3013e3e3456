// Direct coupling: the burr is rigidly the device, and the hand feels the model's force, reconstructed
// between its samples (ForceReconstruction).
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
#include <glm/vec3.hpp>

#include "simulation/coupling/burr_proxy.h"
#include "simulation/coupling/coupling.h"

namespace osteomill {

/// Reconstruction of the force of each haptic tick from those that a model gives once a period: an estimate
/// at the model's rate, then a shape over the period that follows.
///
///     estimate   newest      u_k = F_k
///                trapezoid   u_k = 1.5 F_k - 0.5 F_{k-1}
///                corrected   u_k = 2 F_k - 1.5 F_{k-1} + 0.5 F_{k-2}
///     shape      held        u_k until u_{k+1} arrives
///                line        from what is rendered when u_k arrives to u_k, over one period
///
/// A hold returns more energy than it took, since its force is that of the period's beginning. The estimates
/// hold the mean of the period to come instead: the trapezoid of F_k and F_{k+1} = 2 F_k - F_{k-1}, an
/// extrapolation; `corrected` adds the error of the last estimate. After Ellis, Sarkar and Jenkins (ASME
/// 1996; J. Dyn. Sys. Meas. Control 119:768, 1997), derived anew from that idea. They suit the model's rate
/// only: after a line of ten strides an estimate gains 5 %.
///
/// A line lags by half a period on the average. A tick's force acts until the next, so the tick gives the
/// line's value at its own end: the first stride comes when u_k arrives, and a model at the haptic rate is
/// held, not delayed.
///
/// Nothing resists before the first sample. The estimates assume that this first force was always there, so
/// that a start in the middle of bone does not overshoot.
enum class ForceEstimate { newest, trapezoid, corrected };
enum class ForceShape { held, line };

class ForceReconstruction {
  public:
    /// `period_s` > 0 is the model's.
    ForceReconstruction(ForceEstimate estimate, ForceShape shape, double period_s)
        : estimate_(estimate), shape_(shape), period_s_(period_s) {}

    void reset() noexcept { *this = ForceReconstruction(estimate_, shape_, period_s_); }

    /// The model's next force, seen at `now_s`. Real-time safe.
    void add(const glm::dvec3& force_n, double now_s) noexcept;

    /// The force from `now_s` until the next tick, `tick_s` later. Real-time safe.
    glm::dvec3 over_tick(double now_s, double tick_s) const noexcept { return line_at(now_s + tick_s); }

  private:
    glm::dvec3 estimate() const noexcept;
    glm::dvec3 line_at(double time_s) const noexcept;

    ForceEstimate estimate_;
    ForceShape shape_;
    double period_s_;
    bool has_sample_ = false;
    glm::dvec3 newest_n_{0.0};  // the model's
    glm::dvec3 before_n_{0.0};
    glm::dvec3 before_that_n_{0.0};
    double arrival_s_ = 0.0;  // of the newest
    glm::dvec3 from_n_{0.0};  // the line; a held force is one without length
    glm::dvec3 to_n_{0.0};
};

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
