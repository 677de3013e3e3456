// Edge of a bone's voxels if nobody has chosen one.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace osteomill {

/// Bytes of a session for a voxel: fraction, stiffness, tissue.
inline constexpr double session_bytes_per_voxel = 3.0;

/// A bone with more voxels than this is large to drill.
inline constexpr double usual_voxels = 2e8;
/// Share of the available memory for the bone as the server has it: its mirror, the window and the window's
/// textures hold it again, and half is for other programs.
inline constexpr double usual_share_of_memory = 1.0 / 8.0;

/// `finest_mm`, or longer if a box of `size_mm` would have more than the usual voxels, or take more than the
/// usual share of `available_bytes` (0: not known); rounded up to steps of 0.05 mm, of 0.01 below 0.1.
double usual_spacing_mm(const glm::dvec3& size_mm, double finest_mm, std::uint64_t available_bytes);

}  // namespace osteomill
