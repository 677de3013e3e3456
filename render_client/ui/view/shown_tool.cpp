#include "render_client/ui/view/shown_tool.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace osteomill {

namespace {

/// A real burr's 10,000 rpm would flicker at 30 frames a second; a turn a second shows that it turns and
/// which way.
constexpr double shown_rev_per_s = 0.8;

/// A burr of which nothing has been heard for so long is not shown to turn: its session has ended, or is
/// played no further. One that turns is sent thirty times a second.
constexpr double longest_turning_s = 0.25;

/// A hand's target this close to the burr is where the burr is.
constexpr double nearest_shown_target_mm = 0.05;

}  // namespace

void ShownTool::take(const ToolState& state) {
    state_ = state;
    age_s_ = 0.0;
    is_new_ = true;
}

bool ShownTool::has_turning_burr() const {
    return state_ && state_->spindle_on && age_s_ < longest_turning_s;
}

void ShownTool::turn(double elapsed_s, const SessionInfo* session) {
    shanks_.take_in(session);
    // A frame that took long makes no state old that came with it.
    if (!std::exchange(is_new_, false)) age_s_ += elapsed_s;
    if (!has_turning_burr()) return;
    const Burr* burr = session ? session->burr_of(state_->burr) : nullptr;
    const bool clockwise = !burr || burr->sense == SpindleSense::clockwise;
    // Clockwise seen from the shank is negative about the axis from tip to shank.
    const double change = (clockwise ? -1.0 : 1.0) * 2.0 * std::numbers::pi * shown_rev_per_s * elapsed_s;
    spin_rad_ = std::remainder(spin_rad_ + change, 2.0 * std::numbers::pi);
}

std::optional<ToolState> ShownTool::shown() const {
    std::optional<ToolState> shown = state_;
    if (!shown || !shown_pose_) return shown;
    shown->burr_position_mm = shown->hand_position_mm = shown_pose_->position_mm;
    shown->spindle_axis = shown_pose_->spindle_axis;
    return shown;
}

DrawnTool ShownTool::drawn(const ToolState& shown, const SessionInfo* session,
                           const std::optional<OperatorCommand>& command) const {
    DrawnTool drawn{.state = shown,
                    .spin_rad = spin_rad_,
                    .motion = has_turning_burr() ? BurrMotion::at_speed : BurrMotion::still,
                    .has_handpiece = true};
    if (const Burr* burr = session ? session->burr_of(shown.burr) : nullptr)
        drawn.burr = {burr->diameter_mm, burr->head, burr->edges, burr->sense == SpindleSense::clockwise,
                      shanks_.of(shown.burr)};
    if (command && !shown_pose_ &&
        glm::distance(command->hand_target_mm, shown.burr_position_mm) > nearest_shown_target_mm)
        drawn.hand_target_mm = command->hand_target_mm;
    return drawn;
}

}  // namespace osteomill
