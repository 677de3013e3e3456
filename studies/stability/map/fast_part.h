// The fast part of a force: the residue of a parabola through 61 ticks. From each sample it subtracts the
// value there of the parabola that best fits the 30 ticks on either side (Savitzky and Golay, Analytical
// Chemistry 36:1627, 1964). The parabola follows motion slower than about 16 Hz at 1 kHz: less than a
// hundredth is left of the hand's own swing at 4 Hz, and nearly all at 25 Hz and above.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace osteomill::study {

inline constexpr std::size_t fit_reach_ticks = 30;

/// The fast part of samples [reach, size - reach); empty for a signal that is shorter than the fit.
std::vector<glm::dvec3> fast_part(std::span<const glm::dvec3> signal);

/// Root of the mean squared length; 0 of nothing.
double rms(std::span<const glm::dvec3> signal);

}  // namespace osteomill::study
