#include "simulation/loop/burr_hull.h"

#include <algorithm>
#include <cmath>

#include "common/scene/burr_profile.h"

namespace osteomill {

namespace {

/// Adds balls around a cone; each holds a slice that is as high as the cone is wide there.
void add_cone(const ShankPoint& low, const ShankPoint& high, std::vector<HullBall>& hull) {
    double height_mm = low.height_mm;
    while (height_mm < high.height_mm) {
        const auto radius_at = [&](double at_mm) {
            const double share = (at_mm - low.height_mm) / (high.height_mm - low.height_mm);
            return low.radius_mm + share * (high.radius_mm - low.radius_mm);
        };
        const double next_mm = std::min(height_mm + radius_at(height_mm), high.height_mm);
        const double half_mm = 0.5 * (next_mm - height_mm);
        const double widest_mm = std::max(radius_at(height_mm), radius_at(next_mm));
        hull.push_back({height_mm + half_mm, std::hypot(widest_mm, half_mm)});
        height_mm = next_mm;
    }
}

}  // namespace

std::vector<HullBall> burr_hull(const Burr& burr) {
    std::vector<HullBall> hull;
    if (burr.is_ball()) {
        hull.push_back({0.0, burr.radius_mm()});
    } else {
        const BurrProfile head(burr.head, burr.diameter_mm);
        add_cone({head.tip_height(), burr.radius_mm()}, {head.top_height(), burr.radius_mm()}, hull);
    }
    for (std::size_t i = 0; i + 1 < burr.shank.size(); ++i) add_cone(burr.shank[i], burr.shank[i + 1], hull);
    return hull;
}

}  // namespace osteomill
