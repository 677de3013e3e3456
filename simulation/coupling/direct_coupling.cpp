#include "simulation/coupling/direct_coupling.h"

#include <algorithm>

namespace osteomill {

void ForceReconstruction::add(const glm::dvec3& force_n, double now_s) noexcept {
    before_that_n_ = has_sample_ ? before_n_ : force_n;
    before_n_ = has_sample_ ? newest_n_ : force_n;
    newest_n_ = force_n;
    has_sample_ = true;

    const glm::dvec3 rendered_n = line_at(now_s);
    to_n_ = estimate();
    from_n_ = shape_ == ForceShape::line ? rendered_n : to_n_;
    arrival_s_ = now_s;
}

glm::dvec3 ForceReconstruction::estimate() const noexcept {
    switch (estimate_) {
        case ForceEstimate::trapezoid:
            return 1.5 * newest_n_ - 0.5 * before_n_;
        case ForceEstimate::corrected:
            return 2.0 * newest_n_ - 1.5 * before_n_ + 0.5 * before_that_n_;
        case ForceEstimate::newest:
            break;
    }
    return newest_n_;
}

glm::dvec3 ForceReconstruction::line_at(double time_s) const noexcept {
    const double share = std::clamp((time_s - arrival_s_) / period_s_, 0.0, 1.0);
    return from_n_ + share * (to_n_ - from_n_);
}

DirectCoupling::DirectCoupling(ForceEstimate estimate, ForceShape shape, const CouplingOptions& options)
    : wall_n_per_mm_(options.device.max_stiffness_n_per_mm),
      model_holds_wall_(options.model_holds_wall),
      force_(estimate, shape, options.milling_period_s),
      wall_(0.0, options.device) {}

void DirectCoupling::reset() noexcept {
    force_.reset();
    step_ = 0;
    is_wall_placed_ = false;
}

const glm::dvec3& DirectCoupling::follow_wall(const HandState& hand, const MillingResult& latest) noexcept {
    if (!is_wall_placed_) wall_.place(hand.pose.position_mm);
    is_wall_placed_ = true;
    const glm::dvec3& hand_mm = hand.pose.position_mm;
    const LinearPull pull{wall_n_per_mm_ * (hand_mm - wall_.position_mm()), wall_n_per_mm_};
    if (hand.spindle_on)
        wall_.advance_on_walls(hand_mm, pull, hand.tick_s, latest);
    else
        wall_.advance(hand_mm, hand_mm, pull, hand.tick_s, false, latest);
    return wall_.position_mm();
}

CouplingOutput DirectCoupling::tick(const HandState& hand, const MillingResult& latest) noexcept {
    // With the spindle on, bone that no burr cuts is still a wall, in addition to the model's force.
    const bool is_wall = !model_holds_wall_ && (!hand.spindle_on || latest.engagement.has_walls);
    ToolPose burr = hand.pose;
    if (is_wall) {
        burr.position_mm = follow_wall(hand, latest);
    } else {
        is_wall_placed_ = false;
    }
    if (latest.step != step_) {
        step_ = latest.step;
        const glm::dvec3 wall_n =
            is_wall ? wall_n_per_mm_ * (burr.position_mm - hand.pose.position_mm) : glm::dvec3(0.0);
        force_.add(hand.spindle_on || model_holds_wall_ ? wall_n + latest.force_n : wall_n, hand.now_s);
    }
    return {.force_n = force_.over_tick(hand.now_s, hand.tick_s),
            .burr_pose = burr,
            .shank_torque_n_mm = is_wall ? wall_.shank_torque_n_mm() : glm::dvec3(0.0)};
}

}  // namespace osteomill
