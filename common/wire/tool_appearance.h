// Appearance of a tool: whether two states of it look the same in a picture.
#pragma once

#include "common/session/tool_state.h"

namespace osteomill {

/// Less than a pixel, and about the tremble of a good arm's encoders.
inline constexpr double quiet_motion_mm = 0.002;
/// Less than a plot shows.
inline constexpr double quiet_force_n = 0.002;

/// Whether a viewer that received `sent` would see nothing new in `now`, except for the time. Compare with
/// the state sent last, not with the previous frame, so that slow motion is sent, too.
bool looks_the_same(const ToolState& sent, const ToolState& now);

}  // namespace osteomill
