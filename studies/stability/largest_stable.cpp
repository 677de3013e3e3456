#include "studies/stability/largest_stable.h"

#include <algorithm>
#include <cmath>

namespace osteomill::study {

double largest_stable(const std::function<bool(double gain)>& is_stable, const GainSearch& search) {
    double stable = search.from;
    if (!is_stable(stable)) return search.from;
    double unstable = std::min(stable * search.stride, search.to);
    while (is_stable(unstable)) {
        if (unstable >= search.to) return search.to;
        stable = unstable;
        unstable = std::min(stable * search.stride, search.to);
    }
    while (unstable > stable * (1.0 + search.tolerance)) {
        const double middle = std::sqrt(stable * unstable);
        (is_stable(middle) ? stable : unstable) = middle;
    }
    return stable;
}

}  // namespace osteomill::study
