// The CT for display: HU of the original scan on a grid coarse enough to be sent. It never changes, and no
// force depends on it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/grid.h"

namespace osteomill {

struct CtVolume {
    Grid grid;
    std::vector<std::int16_t> hu;  ///< x fastest, then y, then z; a value for each voxel

    /// Between voxels, trilinear; beyond the grid air (-1000).
    double hu_at(const glm::dvec3& position_mm) const;
};

}  // namespace osteomill
