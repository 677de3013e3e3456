#include "common/scene/burr.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace osteomill {

void require_valid(const ShankProfile& shank, double burr_radius_mm) {
    if (shank.empty()) return;
    constexpr double least_ascent_mm = 0.01;
    if (shank.size() < 2 || shank.size() > 8)
        throw std::invalid_argument("a shank takes 2 to 8 points, not " + std::to_string(shank.size()));
    for (std::size_t i = 0; i < shank.size(); ++i) {
        const std::string point = "shank point " + std::to_string(i);
        if (!(shank[i].radius_mm >= 0.05 && shank[i].radius_mm <= 30.0))
            throw std::invalid_argument(point + " has a radius outside 0.05 to 30 mm");
        if (!(shank[i].height_mm >= 0.5 * burr_radius_mm && shank[i].height_mm <= 200.0))
            throw std::invalid_argument(point + " has a height outside half the burr's radius to 200 mm");
        if (i > 0 && !(shank[i].height_mm - shank[i - 1].height_mm >= least_ascent_mm))
            throw std::invalid_argument(point + " does not lie 0.01 mm or more above the one before");
    }
    if (shank.back().height_mm <= burr_radius_mm)
        throw std::invalid_argument("the shank ends within the burr");
}

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
