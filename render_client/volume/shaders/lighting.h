// Lights fixed to the scene: a key light from the front, above and to the left of the viewer's usual place, a
// weaker fill light opposite, and an ambient light that is brighter from above; diffuse only. Fill and
// ambient light are nearly neutral: bluer and greener ones made ivory in the shade look olive. And the
// background. For surfaces lit on the CPU; lighting.glsl is the same for the shaders, and tests keep the two
// equal.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// Unit, towards the key light; patient axes.
inline constexpr glm::dvec3 key_direction(-0.4364, -0.5455, 0.7155);

/// Light that a surface sends back, linear RGB. `normal` is unit, patient axes; `openness` (0 to 1) is the
/// share of the ambient light that reaches it.
glm::dvec3 lit(const glm::dvec3& colour, const glm::dvec3& normal, double openness);

/// Linear RGB, clamped to 0 to 1, as the display takes it, 0 to 1.
glm::dvec3 display(const glm::dvec3& linear);

/// The background behind the bone in a SceneAppearance's own colours, linear RGB; `place` is 0 to 1 from the
/// picture's lower left corner. Its GLSL is in background.glsl.
glm::dvec3 background_at(const glm::dvec2& place);

}  // namespace osteomill
