// Motion of many sessions in one call, in threads of its own, without the interpreter's lock.
#pragma once

#include <optional>
#include <vector>

#include "python/module/session_motion.h"

namespace osteomill::python {

/// Moves each session along rows of its own, as rollout does, in up to `threads` threads; returns the last
/// tick of each. Each ends as it would alone, to the bit. All lists are of one length. Throws as rollout,
/// before any has moved, and for a session that is listed twice.
std::vector<Tick> step_together(const std::vector<SharedSession>& sessions, const std::vector<Doubles>& hands,
                                const std::vector<std::optional<Doubles>>& axes,
                                const std::vector<Flags>& pedals, int threads);

}  // namespace osteomill::python
