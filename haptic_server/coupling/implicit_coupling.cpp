#include "haptic_server/coupling/implicit_coupling.h"

namespace osteomill {

ImplicitCoupling::ImplicitCoupling(const CouplingOptions& options)
    : spring_n_per_mm_(options.device.max_stiffness_n_per_mm),
      hand_(options.position_resolution_mm),
      proxy_(options.device.max_stiffness_n_per_mm) {}

CouplingOutput ImplicitCoupling::tick(const HandState& hand, const MillingResult& latest) noexcept {
    if (!placed_) {
        proxy_.place(hand.pose.position_mm);
        lag_mm_ = glm::dvec3(0.0);
        lag_rate_mm_per_s_ = glm::dvec3(0.0);
        hand_.reset();
        placed_ = true;
    }
    const glm::dvec3 position_mm = hand_.update(hand.pose.position_mm, hand.tick_s);
    proxy_.advance(position_mm, hand.tick_s, hand.spindle_on, latest);

    const glm::dvec3 lag_mm = position_mm - proxy_.position_mm();
    const double share = hand.tick_s / (damping_filter_s + hand.tick_s);
    lag_rate_mm_per_s_ += share * ((lag_mm - lag_mm_) / hand.tick_s - lag_rate_mm_per_s_);
    lag_mm_ = lag_mm;
    // Out of contact the spring is slack at once; the filter's memory must not be felt in air.
    if (lag_mm == glm::dvec3(0.0)) lag_rate_mm_per_s_ = glm::dvec3(0.0);

    return {.force_n = -spring_n_per_mm_ * lag_mm - damping_n_s_per_mm * lag_rate_mm_per_s_,
            .burr_pose = {proxy_.position_mm(), hand.pose.spindle_axis}};
}

}  // namespace osteomill
