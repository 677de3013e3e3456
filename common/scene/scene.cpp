#include "common/scene/scene.h"

namespace osteomill {

StiffnessRelation stiffness_of(const Scene& scene) {
    StiffnessRelation relation = scene.stiffness;
    for (const Tissue& tissue : scene.tissues)
        if (tissue.strength)
            relation.tissues.push_back({tissue.label, tissue.strength->relative_stiffness});
        else if (tissue.stiffness_factor != 1.0)
            relation.factors.push_back({tissue.label, tissue.stiffness_factor});
    return relation;
}

}  // namespace osteomill
