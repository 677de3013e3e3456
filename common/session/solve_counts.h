// Outcomes of a coupling's contact solves since the start of a session: the largest residual, and how often
// the plain solve failed.
#pragma once

#include <cstdint>

namespace osteomill {

struct SolveCounts {
    double max_residual_n = 0.0;  ///< largest force left over after a tick
    std::uint64_t fallbacks = 0;  ///< ticks without a balance, until they were damped
    std::uint64_t relaxed = 0;    ///< of these, ticks in which normal forces alone were kept
    std::uint64_t damped = 0;     ///< ticks with a balance, damped because bone drove the burr off

    bool operator==(const SolveCounts&) const = default;
};

}  // namespace osteomill
