#include "common/session/structure_distance.h"

namespace osteomill {

const StructureDistance* nearest_structure(std::span<const StructureDistance> distances) {
    const StructureDistance* nearest = nullptr;
    for (const StructureDistance& one : distances)
        if (one.distance_mm && (nearest == nullptr || *one.distance_mm < *nearest->distance_mm))
            nearest = &one;
    return nearest;
}

StructureWarning warning_of(const StructureDistance& now, const Tissue& tissue) {
    if (now.touches) return StructureWarning::touch;
    const bool is_near = now.distance_mm && *now.distance_mm < tissue.warn_mm;
    return is_near ? StructureWarning::near : StructureWarning::none;
}

StructureWarning gravest_warning(std::span<const StructureDistance> distances,
                                 std::span<const Tissue> tissues) {
    StructureWarning gravest = StructureWarning::none;
    for (const StructureDistance& now : distances)
        if (now.tissue < tissues.size()) gravest = std::max(gravest, warning_of(now, tissues[now.tissue]));
    return gravest;
}

}  // namespace osteomill
