// A percentile of some numbers: between two of them in order, it lies on the line that joins them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace osteomill {

/// `share` from 0 to 1. Definition 7 of Hyndman and Fan, "Sample quantiles in statistical packages", The
/// American Statistician 50 (1996). 0 where there are none.
inline double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(place));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(values.begin(), at, values.end());
    if (at + 1 == values.end()) return *at;
    const double above = *std::min_element(at + 1, values.end());
    return *at + (place - static_cast<double>(below)) * (above - *at);
}

}  // namespace osteomill
