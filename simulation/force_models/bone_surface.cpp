#include "simulation/force_models/bone_surface.h"

#include <glm/geometric.hpp>

namespace osteomill {

float length_in_bone(const BrickNeighbourhood& bricks, const glm::vec3& start, const glm::vec3& direction,
                     float longest) noexcept {
    constexpr float step_voxels = 0.5f;
    float inner = bricks.fraction(start);
    for (float gone = step_voxels; gone < longest; gone += step_voxels) {
        const float fraction = bricks.fraction(start + gone * direction);
        if (fraction < surface_fraction)
            return gone - step_voxels * (surface_fraction - fraction) / (inner - fraction);
        inner = fraction;
    }
    return longest;
}

glm::dvec3 outward_normal(const BrickNeighbourhood& bricks, const glm::vec3& position) noexcept {
    glm::dvec3 downhill(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 step(0.0f);
        step[axis] = 1.0f;
        downhill[axis] =
            static_cast<double>(bricks.fraction(position - step) - bricks.fraction(position + step));
    }
    const double steepness = glm::length(downhill);
    return steepness > 0.0 ? downhill / steepness : glm::dvec3(0.0);
}

}  // namespace osteomill
