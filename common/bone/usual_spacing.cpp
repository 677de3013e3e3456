#include "common/bone/usual_spacing.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

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
