#include "render_client/ui/view/hu_axis.h"

#include "common/scene/stiffness_relation.h"

namespace osteomill {

namespace {

constexpr double highest_hu = 4000.0;  // the relation's last knot

const StiffnessRelation& relation() {
    static const StiffnessRelation made = default_stiffness_relation();
    return made;
}

}  // namespace

double stiffness_at_hu(double hu) {
    return relative_stiffness(relation(), hu);
}

double hu_at_stiffness(double wanted) {
    const auto& knots = relation().knots;
    if (wanted <= knots.front().relative_stiffness) return 0.0;
    for (std::size_t i = 1; i < knots.size(); ++i) {
        const StiffnessKnot &low = knots[i - 1], &high = knots[i];
        if (wanted > high.relative_stiffness) continue;
        const double rise = high.relative_stiffness - low.relative_stiffness;
        return low.hu + (high.hu - low.hu) * (wanted - low.relative_stiffness) / rise;
    }
    return highest_hu;
}

}  // namespace osteomill
