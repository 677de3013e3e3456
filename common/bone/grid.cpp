#include "common/bone/grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/bone/patient_space.h"

namespace osteomill {

void require_valid(const Grid& grid) {
    constexpr int largest = 65536;
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.size_voxels[axis] < 1 || grid.size_voxels[axis] > largest)
            throw std::invalid_argument("grid size along axis " + std::to_string(axis) + " is " +
                                        std::to_string(grid.size_voxels[axis]) + ", not 1 to 65536 voxels");
    }
    if (!(std::isfinite(grid.spacing_mm) && grid.spacing_mm > 0.0))
        throw std::invalid_argument("grid spacing is " + std::to_string(grid.spacing_mm) +
                                    " mm, not above zero");
    // A brick's index is 32 bits wide.
    const double bricks = std::ceil(grid.size_voxels.x / 16.0) * std::ceil(grid.size_voxels.y / 16.0) *
                          std::ceil(grid.size_voxels.z / 16.0);
    if (bricks > 0x1p32)
        throw std::invalid_argument("grid has more than 2^32 bricks of 16^3 voxels; crop it or coarsen it");
    if (!is_place(grid.origin_mm) || !is_place(centre_of_voxel_mm(grid, grid.size_voxels - 1)))
        throw std::invalid_argument(
            "grid reaches more than 10 m from the patient's origin, or its origin is no place");
}

double usual_spacing_mm(const glm::dvec3& size_mm, double finest_mm, std::uint64_t available_bytes) {
    double voxels = usual_voxels;
    if (available_bytes > 0)
        voxels = std::min(
            voxels, usual_share_of_memory * static_cast<double>(available_bytes) / session_bytes_per_voxel);
    const double spacing_mm = std::max(finest_mm, std::cbrt(size_mm.x * size_mm.y * size_mm.z / voxels));
    const double steps_per_mm = spacing_mm > 0.1 ? 20.0 : 100.0;
    return std::ceil(steps_per_mm * spacing_mm - 1e-6) / steps_per_mm;
}

}  // namespace osteomill
