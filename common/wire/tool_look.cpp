#include "common/wire/tool_look.h"

#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// A turn that moves the far end of a spindle of 100 mm by quiet_motion_mm.
constexpr double quiet_turn_rad = quiet_motion_mm / 100.0;

}  // namespace

bool looks_the_same(const ToolState& told, const ToolState& now) {
    return told.burr == now.burr && told.spindle_on == now.spindle_on &&
           told.removed_mm3 == now.removed_mm3 && told.touches_protected == now.touches_protected &&
           told.fault == now.fault && told.notice == now.notice && told.driver == now.driver &&
           glm::distance(told.burr_position_mm, now.burr_position_mm) <= quiet_motion_mm &&
           glm::distance(told.hand_position_mm, now.hand_position_mm) <= quiet_motion_mm &&
           glm::distance(told.spindle_axis, now.spindle_axis) <= quiet_turn_rad &&
           glm::distance(told.force_n, now.force_n) <= quiet_force_n;
}

}  // namespace osteomill
