// The CT for people to look at: HU of the original scan on a grid that is as coarse as it must be to be sent.
// Nothing changes it, and no force comes of it.
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
