// Limits of what an operator's hand may ask of a tool. The server holds everybody to it, in its haptic tick;
// a client keeps its own target within reach, too, so that a mouse that comes back moves the tool at once.
#pragma once

namespace osteomill {

/// How far from the burr the target may be, at the arm (ArmScale). Farther off a hand could not feel where it
/// is any more; the spring of the coupling is long saturated.
inline constexpr double longest_reach_mm = 6.0;

/// No hand moves an arm faster.
inline constexpr double fastest_hand_mm_per_s = 500.0;

}  // namespace osteomill
