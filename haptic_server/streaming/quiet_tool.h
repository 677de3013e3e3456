// Whether a tool rests, so that a client need not be told of it thirty times a second.
#pragma once

#include "common/wire/tool_look.h"

namespace osteomill {

/// A tool that rests is told of this often, in session time: often enough for a viewer that waits for its
/// clock to go on.
inline constexpr double quiet_period_s = 0.1;

/// Whether `now` may go untold after `told`: it looks the same and comes less than a quiet period later.
bool is_quiet(const ToolView& told, const ToolView& now);

}  // namespace osteomill
