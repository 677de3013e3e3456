#include "tests/studies/force/bone_block.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "common/bone/bone_builder.h"

namespace osteomill::study {

namespace {

/// Part of the voxel that lies below the plane, 0 to 255.
std::uint8_t fraction_below(const glm::dvec3& centre_mm, const glm::dvec3& up, double spacing_mm) {
    const double height_voxels = glm::dot(centre_mm, up) / spacing_mm;
    constexpr double half_diagonal_voxels = std::numbers::sqrt3 / 2.0;
    if (height_voxels <= -half_diagonal_voxels) return 255;
    if (height_voxels >= half_diagonal_voxels) return 0;
    constexpr int points = 8;
    int below = 0;
    for (int k = 0; k < points; ++k)
        for (int j = 0; j < points; ++j)
            for (int i = 0; i < points; ++i) {
                const glm::dvec3 offset = (glm::dvec3(i, j, k) + 0.5) / static_cast<double>(points) - 0.5;
                below += height_voxels + glm::dot(offset, up) <= 0.0 ? 1 : 0;
            }
    return static_cast<std::uint8_t>(std::lround(255.0 * below / (points * points * points)));
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
        const bool in_layer = block.layer && -glm::dot(centre_mm, block.up) < block.layer->thickness_mm;
        return static_cast<std::uint8_t>(
            std::lround((in_layer ? block.layer->stiffness : 1.0) / stiffness_per_code));
    };
    BoneBuilder builder = block.layer ? BoneBuilder::heterogeneous(grid, stiffness_per_code, false)
                                      : BoneBuilder::homogeneous(grid, 1.0, false);
    const glm::ivec3 bricks = size_in_bricks(grid);
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) {
                ByteBrick fraction{};
                ByteBrick stiffness{};
                for (int k = 0; k < brick_edge_voxels; ++k)
                    for (int j = 0; j < brick_edge_voxels; ++j)
                        for (int i = 0; i < brick_edge_voxels; ++i) {
                            const glm::ivec3 voxel =
                                glm::ivec3(x, y, z) * brick_edge_voxels + glm::ivec3(i, j, k);
                            if (!contains(grid, voxel)) continue;
                            const glm::dvec3 centre_mm = centre_of_voxel_mm(grid, voxel);
                            const std::size_t offset = offset_in_brick(voxel);
                            fraction[offset] = fraction_below(centre_mm, block.up, spacing_mm);
                            if (block.layer) stiffness[offset] = code_of(centre_mm);
                        }
                builder.add_brick({x, y, z}, fraction, &stiffness, nullptr);
            }
    return std::move(builder).build();
}

}  // namespace osteomill::study
