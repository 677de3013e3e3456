// Lights fixed to the scene: a key light from the front, above and to the left of the viewer's usual place, a
// weaker fill light opposite, and an ambient light that is brighter from above. Diffuse only. And what is
// behind. Once for the shaders, once for what is lit on the CPU; tests hold the two together.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// Light that a surface sends back, linear RGB. `normal` is unit, patient axes; `openness` (0 to 1) is how
/// much of the ambient light gets there.
glm::dvec3 lit(const glm::dvec3& colour, const glm::dvec3& normal, double openness);

/// Linear RGB, clamped to 0 to 1, as the display takes it, 0 to 1.
glm::dvec3 display(const glm::dvec3& linear);

/// What is behind the bone in a SceneLook's own colours, linear RGB; `place` is 0 to 1 from the picture's
/// lower left corner. Its GLSL is part of look_glsl.
glm::dvec3 background_at(const glm::dvec2& place);

/// GLSL: the same functions in float: `vec3 lit(vec3 colour, vec3 normal, float openness)` and
/// `vec3 display(vec3 linear)`.
inline constexpr const char* lighting_glsl = R"glsl(
const vec3 key_direction = vec3(-0.4364, -0.5455, 0.7155);
const vec3 fill_direction = vec3(0.8944, -0.2236, 0.3873);

vec3 lit(vec3 colour, vec3 normal, float openness) {
    float key = max(dot(normal, key_direction), 0.0);
    float fill = max(dot(normal, fill_direction), 0.0);
    vec3 ambient = mix(vec3(0.13, 0.12, 0.12), vec3(0.27, 0.29, 0.32), 0.5 + 0.5 * normal.z);
    vec3 light = ambient * openness + vec3(0.66, 0.63, 0.58) * key * mix(0.45, 1.0, openness)
               + vec3(0.15, 0.17, 0.20) * fill * openness;
    return colour * light;
}

vec3 display(vec3 linear) { return pow(clamp(linear, 0.0, 1.0), vec3(1.0 / 2.2)); }
)glsl";

}  // namespace osteomill
