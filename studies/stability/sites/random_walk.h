// A random walk of a hand over bone: a motion that nobody tuned to, the same for a seed and a number on every
// machine.
#pragma once

#include <cstdint>

#include "studies/stability/sites/site.h"

namespace osteomill::study {

inline constexpr double walk_s = 4.0;
inline constexpr double walk_band_hz = 5.0;
inline constexpr double fastest_walk_mm_per_s = 150.0;

/// Walk `number` of a seed: sums of sines up to 5 Hz, at most 20 to 150 mm/s fast, about the surface, edges
/// and corners of a block, a plate or a ridge; burrs of 1 to 5 mm, 5 000 to 80 000 rpm.
Site random_walk(std::uint64_t seed, int number);

}  // namespace osteomill::study
