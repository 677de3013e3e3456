// The edge of stability along one gain (a stiffness, a damping): the gain up to which everything is stable.
#pragma once

#include <functional>

namespace osteomill::study {

struct GainSearch {
    double from = 1.0;
    double to = 1e6;
    double stride = 1.05;  ///< of the scan, a factor; an island of instability narrower than this is missed
    double tolerance = 1e-4;  ///< relative, of the result
};

/// Scans upward in strides to the first unstable gain, then bisects. `from` where that already is unstable,
/// `to` where nothing is.
double largest_stable(const std::function<bool(double gain)>& is_stable, const GainSearch& search = {});

}  // namespace osteomill::study
