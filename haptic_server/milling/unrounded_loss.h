// What a slow burr takes off voxels between two of their 255 steps. At 0.5 mm/s and 100 Hz a voxel at the
// burr's surface loses a step or two at a time, or none and then three, all those in a row of the lattice
// together: the force of a second pass half a voxel deeper ripples by a tenth. The ramp of cover.h is known
// without rounding. A voxel that holds what the burr has left of it,
//
//     old = round(255 g(d_from)),   loses   255 (g(d_from) - g(d_to)),
//
// d the distances from where the step begins and from its way. One that awaits the burr with less than that
// loses max(0, old - 255 g(d_to)), and one that the burr has passed by before keeps to whole steps. Summed
// over steps this is what the bone loses in whole steps, but for less than one of them at the end.
//
// A burr on its way back through its own groove seems to take off the half step that the groove's wall was
// rounded by. Whoever sums must limit that by what was removed lately.
#pragma once

#include "haptic_server/milling/cover_lanes.h"
#include "haptic_server/milling/lanes.h"

namespace osteomill {

/// For voxels at whole numbers, counted from the base of both sweeps: what they lose without rounding less
/// what they lose in whole steps, in steps of 255; of either sign. `from`: the ball where `sweep` begins;
/// `old`: what they held; `left`: what they hold now; zero for voxels of which nothing was left.
template <VoxelEdges edges>
[[gnu::always_inline]] inline lanes::Floats loss_between_steps(const SweepForLanes& from,
                                                               const SweepForLanes& sweep,
                                                               const lanes::Floats& x, const lanes::Floats& y,
                                                               const lanes::Floats& z, const lanes::Ints& old,
                                                               const lanes::Ints& left) {
    using lanes::Floats;
    // Half a step, and what single precision does to it.
    constexpr float half_step = 0.51f;
    const Floats zero{};
    const Floats held = lanes::to_floats(old);
    const Floats lost = held - lanes::to_floats(left);
    const Floats before = code_left<edges>(from, x, y, z);
    const Floats after = code_left<edges>(sweep, x, y, z);
    const Floats off = before - held;
    const Floats awaited = held > after ? held - after : zero;
    const Floats cut = before - after;
    const Floats loss = off > half_step ? awaited : (off < -half_step ? lost : cut);
    return old > 0 ? loss - lost : zero;
}

}  // namespace osteomill
