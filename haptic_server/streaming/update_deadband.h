// A deadband on updates of the tool: one that rests need not be sent to a client thirty times a second.
#pragma once

#include "common/wire/tool_appearance.h"

namespace osteomill {

/// A tool that rests is sent this often, in session time: often enough for a viewer that waits for its
/// clock to go on.
inline constexpr double deadband_period_s = 0.1;

/// Whether `now` need not be sent after `sent`: it looks the same and comes less than a period later.
bool is_within_deadband(const ToolState& sent, const ToolState& now);

}  // namespace osteomill
