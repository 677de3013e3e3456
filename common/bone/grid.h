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

}  // namespace osteomill
