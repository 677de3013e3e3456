#include "simulation/coupling/implicit_coupling.h"

namespace osteomill {

ImplicitCoupling::ImplicitCoupling(const CouplingOptions& options)
    : hand_(options.device.position_resolution_mm),
      proxy_(options.wall_friction, options.device),
      spring_(options.device, burr_filter_s),
      fixtures_(options.fixtures),
      feed_forward_(options.device),
      feeds_forward_(options.feed_forward) {}

CouplingOutput ImplicitCoupling::tick(const HandState& hand, const MillingResult& latest) noexcept {
    if (!placed_) {
        proxy_.place(hand.pose.position_mm);
        spring_.place(hand.pose.position_mm);
        hand_.reset();
        fixtures_.reset();
        feed_forward_.place(hand.pose.position_mm);
        placed_ = true;
    }
    const bool on_wall = !hand.spindle_on || proxy_.touches_wall();
    const glm::dvec3 position_mm = hand_.update(hand.pose.position_mm, hand.tick_s, on_wall);
    LinearPull pull = spring_.follow_hand(position_mm, hand.tick_s);
    const glm::dvec3 from_mm = proxy_.position_mm();
    const bool has_help =
        fixtures_.add_to(pull, {from_mm, hand.pose.spindle_axis}, hand.burr, hand.tick_s, hand.fixtures_on);
    const glm::dvec3 in_air_mm = has_help ? from_mm + pull.free_step_mm() : position_mm;
    proxy_.advance(in_air_mm, position_mm, pull, hand.tick_s, hand.spindle_on, latest);
    fixtures_.settle(proxy_.position_mm() - from_mm);
    glm::dvec3 force_n = spring_.follow_burr(proxy_.position_mm(), hand.tick_s);
    if (feeds_forward_) {
        const glm::dvec3 step_mm = feed_forward_.follow_hand(position_mm, hand.tick_s);
        const double resistance = hand.spindle_on ? proxy_.resistance_n_s_per_mm(step_mm, latest) : 0.0;
        force_n += feed_forward_.tick(resistance, force_n, hand.tick_s);
    }
    return {.force_n = force_n,
            .burr_pose = {proxy_.carving_mm(), hand.pose.spindle_axis},
            .shank_torque_n_mm = proxy_.shank_torque_n_mm()};
}

}  // namespace osteomill
