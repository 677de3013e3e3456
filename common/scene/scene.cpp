#include "common/scene/scene.h"

namespace osteomill {

std::vector<Burr> felt_burrs(const Scene& scene) {
    std::vector<Burr> burrs = scene.burrs;
    for (Burr& burr : burrs) {
        burr.cutting_coefficients_n_per_mm2 *= scene.force_scale;
        burr.edge_coefficients_n_per_mm *= scene.force_scale;
    }
    return burrs;
}

StiffnessRelation stiffness_of(const Scene& scene) {
    StiffnessRelation relation = scene.stiffness;
    for (const Tissue& tissue : scene.tissues)
        if (tissue.strength)
            relation.tissues.push_back(
                {tissue.label, tissue.stiffness_factor * tissue.strength->relative_stiffness});
        else if (tissue.stiffness_factor != 1.0)
            relation.factors.push_back({tissue.label, tissue.stiffness_factor});
    return relation;
}

}  // namespace osteomill
