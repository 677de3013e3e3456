// Estimate of the time that a sweep of like pieces of work still takes.
#pragma once

#include <cstddef>
#include <string>

namespace osteomill::study {

/// "40 s left", "3 min left", "2 h 5 min left", from what `done` of `all` pieces took; "" before the first
/// and after the last.
std::string time_left(std::size_t done, std::size_t all, double elapsed_s);

}  // namespace osteomill::study
