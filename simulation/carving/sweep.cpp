#include "simulation/carving/sweep.h"

#include <algorithm>

namespace osteomill {

bool cut_to_grid(Sweep& sweep, const glm::ivec3& size) noexcept {
    const glm::dvec3 along = sweep.to - sweep.from;
    const double margin = sweep.radius + 1.0;
    double first = 0.0;
    double last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = -margin - sweep.from[axis];
        const double high = size[axis] - 1 + margin - sweep.from[axis];
        if (along[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double a = low / along[axis];
        const double b = high / along[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    if (!(first <= last)) return false;
    const glm::dvec3 from = sweep.from;
    if (first > 0.0) sweep.from = from + first * along;
    if (last < 1.0) sweep.to = from + last * along;
    return true;
}

}  // namespace osteomill
