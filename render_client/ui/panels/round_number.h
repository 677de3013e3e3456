// Round numbers for scales: 1, 2 and 5 times a power of ten.
#pragma once

#include <cmath>

namespace osteomill {

/// The largest that is at most `limit` (above zero), with a margin for rounding errors.
inline double round_number_up_to(double limit) {
    const double decade = std::pow(10.0, std::floor(std::log10(limit) + 1e-9));
    for (const double factor : {5.0, 2.0})
        if (factor * decade <= limit * (1.0 + 1e-9)) return factor * decade;
    return decade;
}

/// The smallest that is at least `limit` (above zero).
inline double round_number_from(double limit) {
    const double below = round_number_up_to(limit);
    if (below >= limit * (1.0 - 1e-9)) return below;
    const double decade = std::pow(10.0, std::floor(std::log10(below) + 1e-9));
    for (const double factor : {2.0, 5.0, 10.0})
        if (factor * decade > below * (1.0 + 1e-9)) return factor * decade;
    return below;
}

}  // namespace osteomill
