#include "imaging/segmentation/bone_of_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "common/scene/stiffness_relation.h"
#include "imaging/bone_from_hu.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

static_assert(2.0 * threshold_of_labels_hu == air_hu + reference_bone_hu);

/// Which labels of a layer of a map are bone.
struct BoneLayer {
    std::shared_ptr<const Segmentation> map;
    int layer = 0;
    std::set<std::uint16_t> labels{};
};

std::vector<BoneLayer> bone_layers(const std::vector<std::shared_ptr<const Segmentation>>& maps,
                                   const std::function<bool(const Segment&)>& is_bone) {
    std::vector<BoneLayer> layers;
    for (const auto& map : maps)
        for (int layer = 0; layer < map->labels.layers(); ++layer) {
            BoneLayer found{.map = map, .layer = layer};
            for (const Segment& segment : map->segments)
                if (segment.layer == layer && is_bone(segment)) found.labels.insert(segment.label);
            if (!found.labels.empty()) layers.push_back(std::move(found));
        }
    return layers;
}

void require_same_lattice(const Segmentation& first, const Segmentation& other) {
    const double of_a_voxel = 1e-2 * glm::length(first.image.spacing_mm);
    const auto apart_mm = [&](const glm::dvec3& voxel) {
        return glm::distance(position_mm(first.image, voxel), position_mm(other.image, voxel));
    };
    const glm::dvec3 last(first.image.size_voxels - 1);
    if (first.image.size_voxels == other.image.size_voxels && apart_mm({0.0, 0.0, 0.0}) < of_a_voxel &&
        apart_mm(last) < of_a_voxel && apart_mm({last.x, 0.0, 0.0}) < of_a_voxel)
        return;
    throw ImagingError(other.path,
                       fmt::format("its voxels are not those of {}: labels that bone is made of share one "
                                   "lattice; what is no bone may come by --segmentation",
                                   first.path.string()));
}

}  // namespace

OpenedImage bone_of_labels(const std::vector<std::shared_ptr<const Segmentation>>& maps,
                           const std::function<bool(const Segment&)>& is_bone) {
    for (const auto& map : maps) require_same_lattice(*maps.front(), *map);
    std::vector<BoneLayer> layers = bone_layers(maps, is_bone);
    if (layers.empty())
        throw ImagingError(maps.front()->path,
                           "none of its segments is bone by its name; say what one is made of: --material "
                           "\"NAME=cortical bone\"");
    OpenedImage opened{.image = maps.front()->image, .read_slices = {}};
    const glm::ivec3 size = opened.image.size_voxels;
    const auto row_voxels = static_cast<std::size_t>(size.x);
    opened.reading_bytes = sizeof(float) * row_voxels * static_cast<std::size_t>(size.y);
    for (const auto& map : maps) opened.reading_bytes += sizeof(LabelRows::Run) * map->labels.runs();
    opened.read_slices = [layers = std::move(layers), size, row_voxels](const TakeSlice& take,
                                                                        const ReportProgress& report) {
        std::vector<float> slice(row_voxels * static_cast<std::size_t>(size.y));
        for (int k = 0; k < size.z; ++k) {
            std::ranges::fill(slice, float{air_hu});
            for (const BoneLayer& bone : layers)
                for (int j = 0; j < size.y; ++j) {
                    const auto row = slice.begin() + static_cast<std::ptrdiff_t>(size.x) * j;
                    std::int32_t first = 0;
                    for (const LabelRows::Run& run : bone.map->labels.row(bone.layer, j, k)) {
                        if (bone.labels.contains(run.label))
                            std::fill(row + first, row + run.end, static_cast<float>(reference_bone_hu));
                        first = run.end;
                    }
                }
            take(k, slice);
            report(static_cast<double>(k + 1) / size.z);
        }
    };
    return opened;
}

}  // namespace osteomill
