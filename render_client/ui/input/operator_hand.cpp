#include "render_client/ui/input/operator_hand.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// Across a tenth of a window a handpiece tilts by about 30 degrees.
constexpr double tilt_rad_per_px = 0.005;

}  // namespace

void OperatorHand::follow(const ToolState& tool, std::size_t burr_count, double reach_mm) {
    if (!tilted_) command_.spindle_axis = tool.spindle_axis;
    if (!burr_chosen_) command_.burr = tool.burr;
    if (burr_count > 0) command_.burr = std::min(command_.burr, burr_count - 1);
    if (!taken_up_) {
        command_.hand_target_mm = tool.hand_position_mm;
        return;
    }
    const glm::dvec3 lead_mm = command_.hand_target_mm - tool.burr_position_mm;
    const double length_mm = glm::length(lead_mm);
    if (length_mm > reach_mm)
        command_.hand_target_mm = tool.burr_position_mm + reach_mm / length_mm * lead_mm;
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
    command_.hand_target_mm -= distance_mm * command_.spindle_axis;
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
