// A homogeneous block of bone for tests, whole or with something left out of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "common/bone/bone_builder.h"

namespace osteomill::testing {

/// A grid that holds the box [low, high] (patient LPS, mm), filled where `depth_mm` of a position is above 0:
/// how far below the bone's surface it lies. A voxel on the surface is filled in part.
inline Bone make_block(const glm::dvec3& low_mm, const glm::dvec3& high_mm, double spacing_mm,
                       const std::function<double(const glm::dvec3&)>& depth_mm) {
    const glm::dvec3 cells = (high_mm - low_mm) / spacing_mm + 0.5;
    const Grid grid{
        .size_voxels = glm::ivec3(cells), .spacing_mm = spacing_mm, .origin_mm = low_mm + 0.5 * spacing_mm};
    return filled(BoneBuilder::homogeneous(grid, 1.0, false), grid, [&](const glm::ivec3& voxel) {
        const glm::dvec3 position_mm = grid.origin_mm + spacing_mm * glm::dvec3(voxel);
        const double share = std::clamp(0.5 + depth_mm(position_mm) / spacing_mm, 0.0, 1.0);
        return VoxelValues{.fraction = static_cast<std::uint8_t>(std::lround(255.0 * share))};
    });
}

/// The same with every voxel filled.
inline Bone make_block(const glm::dvec3& low_mm, const glm::dvec3& high_mm, double spacing_mm) {
    return make_block(low_mm, high_mm, spacing_mm,
                      [](const glm::dvec3&) { return std::numeric_limits<double>::infinity(); });
}

}  // namespace osteomill::testing
