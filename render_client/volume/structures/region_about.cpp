#include "render_client/volume/structures/region_about.h"

#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "common/bone/brick.h"
#include "common/bone/distance_field.h"

namespace osteomill {

namespace {

constexpr double most_voxels = 2e6;

}  // namespace

StructureMask region_about(const StructureMask& structure, double distance_mm) {
    const std::optional<VoxelBounds> bounds = structure.bounds();
    if (!bounds) return {};
    const double fine_mm = structure.grid().spacing_mm;
    const glm::dvec3 low_mm = centre_of_voxel_mm(structure.grid(), bounds->first);
    const glm::dvec3 across_mm = centre_of_voxel_mm(structure.grid(), bounds->last) - low_mm;
    Grid grid{.spacing_mm = fine_mm};
    for (;; grid.spacing_mm *= 1.1) {
        const double margin_mm = distance_mm + 2.0 * grid.spacing_mm;
        grid.origin_mm = low_mm - margin_mm;
        const glm::dvec3 size = glm::ceil((across_mm + 2.0 * margin_mm) / grid.spacing_mm) + 1.0;
        grid.size_voxels = glm::ivec3(size);
        if (size.x * size.y * size.z <= most_voxels) break;
    }
    const DistanceField field(structure, distance_mm + fine_mm);
    const glm::ivec3 size_bricks = size_in_bricks(grid);
    std::vector<StructureBrick> bricks;
    for (int z = 0; z < size_bricks.z; ++z)
        for (int y = 0; y < size_bricks.y; ++y)
            for (int x = 0; x < size_bricks.x; ++x) {
                const glm::ivec3 first = brick_edge_voxels * glm::ivec3(x, y, z);
                StructureBrick brick{.brick = brick_index(size_bricks, {x, y, z})};
                for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
                    const glm::ivec3 voxel = first + voxel_in_brick(offset);
                    if (!contains(grid, voxel)) continue;
                    const std::optional<float> found = field.distance_mm(centre_of_voxel_mm(grid, voxel));
                    if (found && *found <= distance_mm) brick.voxels.set(offset);
                }
                bricks.push_back(brick);
            }
    return {grid, std::move(bricks)};
}

}  // namespace osteomill
