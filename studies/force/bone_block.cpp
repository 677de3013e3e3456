#include "studies/force/bone_block.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "common/bone/bone_builder.h"
#include "simulation/carving/voxel_coverage.h"

namespace osteomill::study {

namespace {

/// Volume of the part of a unit cube about the origin that lies below the plane {p . n = height}, n a unit
/// vector: a cube cut by a plane is a corner tetrahedron less those that stick out of it.
double volume_below(double height, const glm::dvec3& n) {
    // A plane along an edge would divide by zero; this much off the cube's volume changes by less.
    constexpr double least = 1e-4;
    const glm::dvec3 a = glm::max(glm::abs(n), glm::dvec3(least));
    const double span = a.x + a.y + a.z;
    const double top = std::clamp(height + 0.5 * span, 0.0, span);
    const auto cubed = [](double t) { return t > 0.0 ? t * t * t : 0.0; };
    const double sum = cubed(top) - cubed(top - a.x) - cubed(top - a.y) - cubed(top - a.z) +
                       cubed(top - a.x - a.y) + cubed(top - a.y - a.z) + cubed(top - a.z - a.x);
    return std::clamp(sum / (6.0 * a.x * a.y * a.z), 0.0, 1.0);
}

/// Part of the voxel that lies below the block's surface, 0 to 255.
std::uint8_t fraction_below(const glm::dvec3& centre_mm, const BoneBlock& block, double spacing_mm) {
    const double height_mm = block.surface_mm - glm::dot(centre_mm, block.up);
    if (block.is_milled)
        return static_cast<std::uint8_t>(level_left_at(VoxelCoverage::smoothed, height_mm / spacing_mm));
    return static_cast<std::uint8_t>(std::lround(255.0 * volume_below(height_mm / spacing_mm, block.up)));
}

}  // namespace

Bone voxelised(const BoneBlock& block, double spacing_mm) {
    // A hair of slack, so that 0.3 / 0.1 counts as 3 multiples.
    const glm::dvec3 first = glm::floor(block.low_mm / spacing_mm + 1e-6);
    const glm::dvec3 last = glm::ceil(block.high_mm / spacing_mm - 1e-6);
    const Grid grid{.size_voxels = glm::ivec3(last - first),
                    .spacing_mm = spacing_mm,
                    .origin_mm = (first + 0.5) * spacing_mm};
    constexpr double stiffness_per_code = 0.02;
    const auto code_of = [&](const glm::dvec3& centre_mm) {
        const bool in_layer =
            block.layer && block.surface_mm - glm::dot(centre_mm, block.up) < block.layer->thickness_mm;
        return static_cast<std::uint8_t>(
            std::lround((in_layer ? block.layer->stiffness : 1.0) / stiffness_per_code));
    };
    BoneBuilder builder = block.layer ? BoneBuilder::heterogeneous(grid, stiffness_per_code, false)
                                      : BoneBuilder::homogeneous(grid, 1.0, false);
    return filled(std::move(builder), grid, [&](const glm::ivec3& voxel) {
        const glm::dvec3 centre_mm = centre_of_voxel_mm(grid, voxel);
        return VoxelValues{.fraction = fraction_below(centre_mm, block, spacing_mm),
                           .stiffness = code_of(centre_mm)};
    });
}

Bone cube_of_bone(int edge_voxels, double spacing_mm, int box_voxels) {
    const int box = box_voxels > 0 ? box_voxels : edge_voxels;
    if (edge_voxels <= 0 || box < edge_voxels || edge_voxels % brick_edge_voxels != 0 ||
        box % brick_edge_voxels != 0)
        throw std::invalid_argument("a cube of bone and its box have edges of multiples of 16 voxels");
    const double half_mm = 0.5 * edge_voxels * spacing_mm;
    const Grid grid{.size_voxels = glm::ivec3(box),
                    .spacing_mm = spacing_mm,
                    .origin_mm = glm::dvec3(-half_mm, -half_mm, -2.0 * half_mm) + 0.5 * spacing_mm};
    BoneBuilder builder = BoneBuilder::homogeneous(grid, 1.0, false);
    ByteBrick full;
    full.fill(255);
    const int bricks = edge_voxels / brick_edge_voxels;
    for (int z = 0; z < bricks; ++z)
        for (int y = 0; y < bricks; ++y)
            for (int x = 0; x < bricks; ++x) builder.add_brick({x, y, z}, full, nullptr, nullptr);
    return std::move(builder).build();
}

}  // namespace osteomill::study
