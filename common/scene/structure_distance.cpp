#include "common/scene/structure_distance.h"

namespace osteomill {

const StructureDistance* nearest_structure(std::span<const StructureDistance> distances) {
    const StructureDistance* nearest = nullptr;
    for (const StructureDistance& one : distances)
        if (one.distance_mm && (nearest == nullptr || *one.distance_mm < *nearest->distance_mm))
            nearest = &one;
    return nearest;
}

}  // namespace osteomill
