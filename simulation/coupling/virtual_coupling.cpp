#include "simulation/coupling/virtual_coupling.h"

namespace osteomill {

namespace {

constexpr double m_per_mm = 0.001;

}  // namespace

VirtualCoupling::VirtualCoupling(const CouplingOptions& options)
    : mass_n_s2_per_mm_(m_per_mm * options.device.apparent_mass_kg),
      model_holds_wall_(options.model_holds_wall),
      hand_(options.device.position_resolution_mm),
      tie_(options.device, CouplingSpring::hand_filter_s),
      tool_(options.wall_friction, options.device),
      fixtures_(options.fixtures) {}

CouplingOutput VirtualCoupling::tick(const HandState& hand, const MillingResult& latest) noexcept {
    if (!placed_) {
        hand_.reset();
        fixtures_.reset();
        tie_.place(hand.pose.position_mm);
        tool_.place(hand.pose.position_mm);
        velocity_mm_per_s_ = glm::dvec3(0.0);
        placed_ = true;
    }
    const glm::dvec3 hand_mm = hand_.update(hand.pose.position_mm, hand.tick_s);
    LinearPull pull = tie_.follow_hand(hand_mm, hand.tick_s);
    const double inertia_n_s_per_mm = mass_n_s2_per_mm_ / hand.tick_s;
    pull.offset_n += inertia_n_s_per_mm * velocity_mm_per_s_;
    pull.stiffness_n_per_mm += inertia_n_s_per_mm / hand.tick_s;

    const glm::dvec3 from_mm = tool_.position_mm();
    fixtures_.add_to(pull, {from_mm, hand.pose.spindle_axis}, hand.burr, hand.tick_s, hand.fixtures_on);
    if (model_holds_wall_) {
        pull.offset_n += latest.force_n;
        tool_.place(from_mm + pull.free_step_mm());
    } else {
        tool_.advance(from_mm + pull.free_step_mm(), hand_mm, pull, hand.tick_s, hand.spindle_on, latest);
    }
    fixtures_.settle(tool_.position_mm() - from_mm);
    velocity_mm_per_s_ = (tool_.position_mm() - from_mm) / hand.tick_s;
    return {.force_n = tie_.follow_burr(tool_.position_mm(), hand.tick_s),
            .burr_pose = {tool_.carving_mm(), hand.pose.spindle_axis},
            .shank_torque_n_mm = tool_.shank_torque_n_mm()};
}

}  // namespace osteomill
