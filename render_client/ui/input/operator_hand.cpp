#include "render_client/ui/input/operator_hand.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

namespace {

/// Across a tenth of a window a handpiece tilts by about 30 degrees.
constexpr double tilt_rad_per_px = 0.005;

/// A burr whose force goes off is lifted so far, more than an arm's friction keeps a hand from its target.
constexpr double lift_mm = 1.0;

/// A burr that bone holds back is pushed by less of the reach: the hand pushes harder by itself, up to as
/// much as it ever does, and a burr that breaks through falls less far.
constexpr double share_of_reach_at_bone = 0.5;
constexpr double held_back_n = 0.1;

}  // namespace

void OperatorHand::follow(const ToolState& tool, std::size_t burr_count, double reach_mm) {
    if (!tilted_) command_.spindle_axis = tool.spindle_axis;
    if (!burr_chosen_) command_.burr = tool.burr;
    if (burr_count > 0) command_.burr = std::min(command_.burr, burr_count - 1);
    burr_mm_ = tool.burr_position_mm;
    const bool had_force = std::exchange(has_force_, tool.fault.empty());
    if (has_force_)
        felt_burr_mm_ = burr_mm_;
    else if (had_force)
        command_.hand_target_mm = felt_burr_mm_ + lift_mm * command_.spindle_axis;
    if (!taken_up_) {
        command_.hand_target_mm = tool.hand_position_mm;
        return;
    }
    const glm::dvec3 lead_mm = command_.hand_target_mm - tool.burr_position_mm;
    const double length_mm = glm::length(lead_mm);
    const double most_mm =
        glm::length(tool.force_n) > held_back_n ? share_of_reach_at_bone * reach_mm : reach_mm;
    if (length_mm > most_mm) command_.hand_target_mm = tool.burr_position_mm + most_mm / length_mm * lead_mm;
}

void OperatorHand::move_in_picture(const glm::dvec2& moved_px, const Camera& camera,
                                   const glm::ivec2& size_px) {
    taken_up_ = true;
    const double mm_per_px = mm_per_px_at(camera, command_.hand_target_mm, size_px);
    command_.hand_target_mm += mm_per_px * (moved_px.x * camera.right() - moved_px.y * camera.up());
}

void OperatorHand::go_to(const glm::dvec3& place_mm) {
    taken_up_ = true;
    command_.hand_target_mm = place_mm;
}

void OperatorHand::advance(double distance_mm) {
    taken_up_ = true;
    if (distance_mm > 0.0 && !has_force_) return;
    const glm::dvec3& axis = command_.spindle_axis;
    const double ahead_mm = glm::dot(burr_mm_ - command_.hand_target_mm, axis);
    if (distance_mm < 0.0 && ahead_mm > 0.0) command_.hand_target_mm += ahead_mm * axis;
    command_.hand_target_mm -= distance_mm * axis;
}

void OperatorHand::tilt_in_picture(const glm::dvec2& moved_px, const Camera& camera) {
    const glm::dvec3 moved = tilt_rad_per_px * (moved_px.x * camera.right() - moved_px.y * camera.up());
    const glm::dvec3 axis = command_.spindle_axis + moved;
    if (glm::length(axis) < 1e-3) return;
    tilted_ = true;
    command_.spindle_axis = glm::normalize(axis);
}

void OperatorHand::choose_burr(std::size_t burr) {
    burr_chosen_ = true;
    command_.burr = burr;
}

void OperatorHand::let_go() {
    taken_up_ = false;
    command_.pedal = false;
    burr_chosen_ = false;
    tilted_ = false;
}

}  // namespace osteomill
