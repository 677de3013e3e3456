// A percentile of some numbers, interpolated linearly between two of them in order.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace osteomill {

/// `share` from 0 to 1. Definition 7 of Hyndman and Fan, "Sample quantiles in statistical packages", The
/// American Statistician 50 (1996). 0 if there are no values.
inline double percentile(std::span<const double> values, double share) {
    if (values.empty()) return 0.0;
    std::vector<double> partly_sorted(values.begin(), values.end());
    const double rank = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(rank));
    const auto at = partly_sorted.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(partly_sorted.begin(), at, partly_sorted.end());
    if (at + 1 == partly_sorted.end()) return *at;
    const double above = *std::min_element(at + 1, partly_sorted.end());
    return *at + (rank - static_cast<double>(below)) * (above - *at);
}

}  // namespace osteomill
