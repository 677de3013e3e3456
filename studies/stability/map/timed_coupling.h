// Time that a coupling takes for a haptic tick, apart from the loop that it runs in.
#pragma once

#include <string>
#include <vector>

namespace osteomill::study {

/// Microseconds of each of `ticks` ticks, of a hand that leads a 5 mm burr along a slot of 1 mm at 6 mm/s and
/// 10 000 rpm; milled after each, with the engagement that the coupling asks for. Throws as make_coupling().
std::vector<double> coupling_tick_us(const std::string& method, int ticks);

}  // namespace osteomill::study
