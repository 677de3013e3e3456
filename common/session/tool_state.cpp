#include "common/session/tool_state.h"

#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// A turn that moves the far end of a spindle of 100 mm by quiet_motion_mm.
constexpr double quiet_turn_rad = quiet_motion_mm / 100.0;

}  // namespace

bool looks_the_same(const ToolState& sent, const ToolState& now) {
    return sent.burr == now.burr && sent.spindle_on == now.spindle_on &&
           sent.removed_mm3 == now.removed_mm3 && sent.touches_protected == now.touches_protected &&
           sent.cut.has_value() == now.cut.has_value() && sent.fault == now.fault &&
           sent.notice == now.notice && sent.driver == now.driver && sent.fixtures_on == now.fixtures_on &&
           sent.fixtures_acting == now.fixtures_acting &&
           glm::distance(sent.burr_position_mm, now.burr_position_mm) <= quiet_motion_mm &&
           glm::distance(sent.hand_position_mm, now.hand_position_mm) <= quiet_motion_mm &&
           glm::distance(sent.spindle_axis, now.spindle_axis) <= quiet_turn_rad &&
           glm::distance(sent.force_n, now.force_n) <= quiet_force_n;
}

}  // namespace osteomill
