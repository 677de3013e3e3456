// The lattice of voxels on which a bone is stored: isotropic, axis-aligned in patient LPS.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace osteomill {

/// An isotropic grid. Voxel (i, j, k) is a cube of edge `spacing_mm` whose centre lies at
/// `origin_mm + spacing_mm * (i, j, k)` in patient LPS (x to the patient's left, y to the back, z up).
struct Grid {
    glm::ivec3 size_voxels{0};
    double spacing_mm = 0.1;
    glm::dvec3 origin_mm{0.0};  ///< centre of voxel (0, 0, 0), patient LPS

    bool operator==(const Grid&) const = default;
};

/// Centre of a voxel, patient LPS, mm.
inline glm::dvec3 centre_of_voxel_mm(const Grid& grid, const glm::ivec3& voxel) {
    return grid.origin_mm + grid.spacing_mm * glm::dvec3(voxel);
}

/// Continuous voxel coordinates of a patient-space point: voxel centres are at whole numbers.
inline glm::dvec3 to_voxel_coordinates(const Grid& grid, const glm::dvec3& position_mm) {
    return (position_mm - grid.origin_mm) / grid.spacing_mm;
}

/// Volume of one voxel, mm^3.
inline double voxel_volume_mm3(const Grid& grid) {
    return grid.spacing_mm * grid.spacing_mm * grid.spacing_mm;
}

inline bool contains(const Grid& grid, const glm::ivec3& voxel) {
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < grid.size_voxels.x &&
           voxel.y < grid.size_voxels.y && voxel.z < grid.size_voxels.z;
}

/// Throws std::invalid_argument, naming the value, unless every size is 1 to 65536 voxels, the spacing is
/// finite and positive, the origin is finite, and a 32-bit index can number the grid's bricks of 16^3 voxels.
void require_valid(const Grid& grid);

// Edge of a bone's voxels if nobody has chosen one.

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
