#include "haptic_server/coupling/interpolated_coupling.h"

#include <algorithm>

namespace osteomill {

InterpolatedCoupling::InterpolatedCoupling(const CouplingOptions& options)
    : spring_n_per_mm_(options.device.max_stiffness_n_per_mm),
      milling_period_s_(options.milling_period_s),
      model_holds_wall_(options.model_holds_wall),
      wall_(options.device.max_stiffness_n_per_mm) {}

void InterpolatedCoupling::reset() noexcept {
    wall_placed_ = false;
    step_ = 0;
    before_n_ = newest_n_ = glm::dvec3(0.0);
}

CouplingOutput InterpolatedCoupling::tick(const HandState& hand, const MillingResult& latest) noexcept {
    if (!hand.spindle_on && !model_holds_wall_) {
        if (!wall_placed_) wall_.place(hand.pose.position_mm);
        wall_placed_ = true;
        wall_.advance(hand.pose.position_mm, hand.tick_s, false, latest);
        before_n_ = newest_n_ = spring_n_per_mm_ * (wall_.position_mm() - hand.pose.position_mm);
        step_ = latest.step;
        return {.force_n = newest_n_, .burr_pose = {wall_.position_mm(), hand.pose.spindle_axis}};
    }
    wall_placed_ = false;

    const auto rendered = [&] {
        const double share = std::clamp((hand.now_s - arrival_s_) / milling_period_s_, 0.0, 1.0);
        return before_n_ + share * (newest_n_ - before_n_);
    };
    if (latest.step != step_) {
        before_n_ = rendered();
        newest_n_ = latest.force_n;
        arrival_s_ = hand.now_s;
        step_ = latest.step;
    }
    return {.force_n = rendered(), .burr_pose = hand.pose};
}

}  // namespace osteomill
