#include "render_client/volume/bone_grain.h"

#include <glm/common.hpp>

namespace osteomill {

// Trabecular bone has about a tenth of cortical bone's stiffness, enamel more than twice as much
// (bone_colours.cpp).
glm::vec2 grain_of_stiffness(double relative_stiffness) {
    constexpr double cortical_fine = 0.08, cortical_coarse = 0.05, trabecular_coarse = 0.20;
    const double trabecular = 1.0 - glm::smoothstep(0.15, 0.5, relative_stiffness);
    const double enamel = glm::smoothstep(1.5, 2.2, relative_stiffness);
    return {static_cast<float>(cortical_fine * (1.0 - 0.8 * enamel)),
            static_cast<float>(glm::mix(cortical_coarse, trabecular_coarse, trabecular) * (1.0 - enamel))};
}

}  // namespace osteomill
