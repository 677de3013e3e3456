#include "haptic_server/coupling/virtual_coupling.h"

namespace osteomill {

VirtualCoupling::VirtualCoupling(const CouplingOptions& options)
    : tool_mass_kg_(options.device.apparent_mass_kg),
      hand_(options.device.position_resolution_mm),
      tie_(options.device, CouplingSpring::hand_filter_s),
      bone_(ForceEstimate::newest, ForceShape::held, options) {}

void VirtualCoupling::reset() noexcept {
    bone_.reset();
    placed_ = false;
}

CouplingOutput VirtualCoupling::tick(const HandState& hand, const MillingResult& latest) noexcept {
    if (!placed_) {
        hand_.reset();
        tie_.place(hand.pose.position_mm);
        tool_mm_ = hand.pose.position_mm;
        tool_mm_per_s_ = glm::dvec3(0.0);
        placed_ = true;
    }
    const glm::dvec3 hand_mm = hand_.update(hand.pose.position_mm, hand.tick_s);
    tie_.follow_hand(hand_mm, hand.tick_s);
    const glm::dvec3 force_on_hand_n = tie_.follow_burr(tool_mm_, hand.tick_s);

    HandState tool = hand;
    tool.pose.position_mm = tool_mm_;
    tool.velocity_mm_per_s = tool_mm_per_s_;
    const CouplingOutput bone = bone_.tick(tool, latest);

    constexpr double mm_per_m = 1000.0;
    tool_mm_per_s_ += mm_per_m * hand.tick_s / tool_mass_kg_ * (bone.force_n - force_on_hand_n);
    tool_mm_ += hand.tick_s * tool_mm_per_s_;
    return {
        .force_n = force_on_hand_n, .burr_pose = bone.burr_pose, .shank_torque_n_mm = bone.shank_torque_n_mm};
}

}  // namespace osteomill
