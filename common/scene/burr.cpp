#include "common/scene/burr.h"

#include <algorithm>

namespace osteomill {

bool has_shank(const std::vector<Burr>& burrs) {
    return std::any_of(burrs.begin(), burrs.end(), [](const Burr& burr) { return !burr.shank.empty(); });
}

std::vector<Burr> default_burr_set(double spindle_rev_per_s) {
    const auto burr = [&](const char* name, double diameter_mm) {
        return Burr{.name = name, .diameter_mm = diameter_mm, .spindle_rev_per_s = spindle_rev_per_s};
    };
    return {burr("1 mm", 1.0), burr("1.5 mm", 1.5), burr("2 mm", 2.0),
            burr("3 mm", 3.0), burr("4 mm", 4.0),   burr("5 mm", 5.0)};
}

}  // namespace osteomill
