#include "render_client/volume/shaders/lighting.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render_client/volume/scene_appearance.h"

namespace osteomill {

glm::dvec3 lit(const glm::dvec3& colour, const glm::dvec3& normal, double openness) {
    constexpr glm::dvec3 fill_direction(0.8944, -0.2236, 0.3873);
    const double key = std::max(glm::dot(normal, key_direction), 0.0);
    const double fill = std::max(glm::dot(normal, fill_direction), 0.0);
    const glm::dvec3 ambient =
        glm::mix(glm::dvec3(0.14, 0.125, 0.115), glm::dvec3(0.285, 0.28, 0.29), 0.5 + 0.5 * normal.z);
    return colour * (ambient * openness + glm::dvec3(0.66, 0.63, 0.58) * key * glm::mix(0.45, 1.0, openness) +
                     glm::dvec3(0.17, 0.165, 0.175) * fill * openness);
}

glm::dvec3 display(const glm::dvec3& linear) {
    return glm::pow(glm::clamp(linear, 0.0, 1.0), glm::dvec3(1.0 / 2.2));
}

glm::dvec3 background_at(const glm::dvec2& place) {
    const SceneAppearance look;
    const glm::dvec3 shade = glm::mix(glm::dvec3(look.background_low), glm::dvec3(look.background_high),
                                      glm::smoothstep(0.0, 1.0, place.y));
    return shade * (1.0 - 0.35 * glm::dot(place - 0.5, place - 0.5));
}

}  // namespace osteomill
