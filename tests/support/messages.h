// Messages of the programs that more than two tests expect.
#pragma once

#include <string>

namespace osteomill::testing {

inline const std::string certificate_refused = "its certificate is not accepted";
inline constexpr const char* device_lost = "the haptic device does not answer: force off";
inline constexpr const char* impossible_compression = "no scan compresses so";
inline constexpr const char* needs_real_clock = "a person needs --clock real";
inline constexpr const char* sides_are_a_guess = "left and right are a guess";

}  // namespace osteomill::testing
