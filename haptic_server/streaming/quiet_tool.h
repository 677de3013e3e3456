// Whether a tool rests, so that a client need not be told of it thirty times a second.
#pragma once

#include "common/wire/tool_view.h"

namespace osteomill {

/// A tool that rests is told of this often, in session time: often enough for a viewer that waits for its
/// clock to go on.
inline constexpr double quiet_period_s = 0.1;

/// Less than a pixel shows, and about what a good arm's encoders tremble by.
inline constexpr double quiet_motion_mm = 0.002;
/// Less than a plot shows.
inline constexpr double quiet_force_n = 0.002;

/// Whether a viewer who was told of `told` would see nothing new in `now`, except for the time. Compare with
/// what was told last, not with the frame before: then slow motion is told, too.
bool looks_the_same(const ToolView& told, const ToolView& now);

/// Whether `now` may go untold after `told`: it looks the same and comes less than a quiet period later.
bool is_quiet(const ToolView& told, const ToolView& now);

}  // namespace osteomill
