#include "common/bone/ct_volume.h"

#include <cstddef>
#include <glm/common.hpp>

namespace osteomill {

double CtVolume::hu_at(const glm::dvec3& position_mm) const {
    constexpr double air_hu = -1000.0;
    const glm::dvec3 at = to_voxel_coordinates(grid, position_mm);
    const glm::ivec3 first(glm::floor(at));
    const glm::dvec3 part = at - glm::dvec3(first);
    const auto value = [&](int dx, int dy, int dz) {
        const glm::ivec3 voxel = first + glm::ivec3(dx, dy, dz);
        if (!contains(grid, voxel)) return air_hu;
        const auto index =
            static_cast<std::size_t>(voxel.x) +
            static_cast<std::size_t>(grid.size_voxels.x) *
                (static_cast<std::size_t>(voxel.y) +
                 static_cast<std::size_t>(grid.size_voxels.y) * static_cast<std::size_t>(voxel.z));
        return static_cast<double>(hu[index]);
    };
    const auto row = [&](int dy, int dz) { return glm::mix(value(0, dy, dz), value(1, dy, dz), part.x); };
    return glm::mix(glm::mix(row(0, 0), row(1, 0), part.y), glm::mix(row(0, 1), row(1, 1), part.y), part.z);
}

}  // namespace osteomill
