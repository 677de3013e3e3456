// Grain of bone: how much its colour varies from place to place, by its stiffness. Cortical bone has fine
// pores, trabecular bone a coarse weave of rods and marrow, enamel nearly none. The pattern is grain.glsl's;
// cell sizes and strengths are the project's judgement.
#pragma once

#include <array>
#include <glm/vec2.hpp>

namespace osteomill {

/// Edges of the pattern's cells, as in grain.glsl.
inline constexpr double fine_grain_mm = 0.25, coarse_grain_mm = 0.9;

/// Greatest share by which the fine grain (x) and the coarse grain (y) of a voxel code make its colour
/// lighter or darker.
using GrainTable = std::array<glm::vec2, 256>;

/// The grain of bone of a relative stiffness (at least 0).
glm::vec2 grain_of_stiffness(double relative_stiffness);

}  // namespace osteomill
