// Limits on the targets of an operator's hand. The server enforces them for every client, in its haptic tick.
// A client also keeps its own target within reach, so that a mouse that turns back moves the tool at once.
#pragma once

namespace osteomill {

/// Greatest distance of the target from the burr, at the arm (ArmScale). Beyond it a hand could no longer
/// feel its position; the coupling's spring is long saturated.
inline constexpr double longest_reach_mm = 6.0;

/// No hand moves an arm faster.
inline constexpr double fastest_hand_mm_per_s = 500.0;

}  // namespace osteomill
