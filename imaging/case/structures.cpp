#include "imaging/case/structures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/bone/structure_mask.h"
#include "imaging/imaging_error.h"
#include "imaging/resampling/region.h"
#include "imaging/segmentation/segment_structure.h"

namespace osteomill {

std::vector<Structure> segmented_structures(const Scene& scene, const std::filesystem::path& segmentation,
                                            const Grid& grid) {
    std::vector<Structure> structures;
    const Segmentation read = read_segmentation(segmentation);
    for (std::size_t index = 0; index < scene.tissues.size(); ++index) {
        const Tissue& tissue = scene.tissues[index];
        if (tissue.segment.empty()) continue;
        StructureMask mask = structure_of(read, segment_named(read, tissue.segment), grid);
        if (mask.empty()) {
            const ScanRegion bone{grid.origin_mm, centre_of_voxel_mm(grid, grid.size_voxels - 1)};
            throw ImagingError(
                segmentation,
                fmt::format("no voxel of the bone is in its segment \"{}\" (tissue \"{}\"): the "
                            "segmentation covers {}, the bone {} (mm, patient LPS)",
                            tissue.segment, tissue.name, to_text(extent_of(read.image)), to_text(bone)));
        }
        structures.push_back({index, std::move(mask)});
    }
    return structures;
}

FillLabels label_painter(const Scene& scene, const std::vector<Structure>& structures) {
    std::vector<const Structure*> order;
    for (const Structure& one : structures) order.push_back(&one);
    const auto* planned = scene.plan ? std::get_if<TissueRegion>(&scene.plan->region) : nullptr;
    const auto rank = [&](const Structure* one) {
        const Tissue& tissue = scene.tissues[one->tissue];
        if (tissue.is_protected) return 2;
        return planned != nullptr && tissue.name == planned->tissue ? 1 : 0;
    };
    std::ranges::stable_sort(order, {}, rank);
    return [&scene, order = std::move(order)](int z, std::span<std::uint8_t> labels) {
        for (const Structure* one : order) {
            const Grid& grid = one->mask.grid();
            const glm::ivec3 size = size_in_bricks(grid);
            const std::size_t nx = static_cast<std::size_t>(grid.size_voxels.x);
            const std::size_t slice = nx * static_cast<std::size_t>(grid.size_voxels.y);
            const int end = z + static_cast<int>(labels.size() / slice);
            const std::uint8_t label = scene.tissues[one->tissue].label;
            const auto first =
                std::ranges::lower_bound(one->mask.bricks(), brick_index(size, {0, 0, z / brick_edge_voxels}),
                                         {}, &StructureBrick::brick);
            for (auto brick = first; brick != one->mask.bricks().end(); ++brick) {
                const glm::ivec3 corner = brick_edge_voxels * brick_position(size, brick->brick);
                if (corner.z >= end) break;
                brick->voxels.for_each([&](std::size_t offset) {
                    const glm::ivec3 voxel = corner + voxel_in_brick(offset);
                    if (voxel.z < z || voxel.z >= end) return;
                    labels[static_cast<std::size_t>(voxel.x) + nx * static_cast<std::size_t>(voxel.y) +
                           slice * static_cast<std::size_t>(voxel.z - z)] = label;
                });
            }
        }
    };
}

void add_structures_in_bone(const Scene& scene, const Bone& bone, std::vector<Structure>& structures) {
    for (std::size_t index = 0; index < scene.tissues.size(); ++index) {
        const Tissue& tissue = scene.tissues[index];
        if (!tissue.is_protected || !tissue.segment.empty()) continue;
        structures.push_back({index, structure_in_bone(bone, tissue.label)});
    }
    std::ranges::sort(structures, {}, &Structure::tissue);
}

std::vector<Structure> structures_outside_bone_labels(const std::vector<Structure>& structures,
                                                      const Scene& scene, const Bone& bone) {
    std::vector<Structure> others;
    for (const Structure& one : structures) {
        const Tissue& tissue = scene.tissues[one.tissue];
        if (!tissue.segment.empty() && one.mask != structure_in_bone(bone, tissue.label))
            others.push_back(one);
    }
    return others;
}

}  // namespace osteomill
