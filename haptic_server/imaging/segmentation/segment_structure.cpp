#include "haptic_server/imaging/segmentation/segment_structure.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "haptic_server/imaging/in_parallel.h"
#include "haptic_server/imaging/resampling/image_part.h"
#include "haptic_server/imaging/resampling/refine.h"
#include "haptic_server/imaging/resampling/region.h"

namespace osteomill {

namespace {

constexpr float inside = 1000.0F;
constexpr std::int16_t on_the_surface = 500;

class SegmentVoxels {
  public:
    SegmentVoxels(const Segmentation& segmentation, const Segment& segment)
        : labels_(segmentation.labels),
          size_(segmentation.image.size_voxels),
          layers_(static_cast<std::size_t>(segmentation.layers)),
          layer_(static_cast<std::size_t>(segment.layer)),
          label_(segment.label) {}

    bool operator()(const glm::ivec3& voxel) const {
        const std::size_t place = static_cast<std::size_t>(voxel.x) +
                                  static_cast<std::size_t>(size_.x) *
                                      (static_cast<std::size_t>(voxel.y) +
                                       static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(voxel.z));
        return labels_[place * layers_ + layer_] == label_;
    }

    /// Smallest box round them.
    std::optional<ImageBox> bounds() const {
        ImageBox box{glm::ivec3(std::numeric_limits<int>::max()), glm::ivec3(-1)};
        glm::ivec3 voxel;
        for (voxel.z = 0; voxel.z < size_.z; ++voxel.z)
            for (voxel.y = 0; voxel.y < size_.y; ++voxel.y)
                for (voxel.x = 0; voxel.x < size_.x; ++voxel.x)
                    if ((*this)(voxel)) {
                        box.first = glm::min(box.first, voxel);
                        box.last = glm::max(box.last, voxel);
                    }
        if (box.last.x < 0) return std::nullopt;
        return box;
    }

  private:
    std::span<const std::uint16_t> labels_;
    glm::ivec3 size_;
    std::size_t layers_, layer_;
    std::uint16_t label_;
};

/// What of the bone's grid the box may reach, a voxel of the scan around it, in whole bricks.
std::optional<VoxelBounds> bricks_over(const SourceImage& image, const ImageBox& box, const Grid& grid) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 side(corner & 1, corner & 2, corner & 4);
        const glm::dvec3 at_mm =
            position_mm(image, glm::mix(glm::dvec3(box.first) - 1.0, glm::dvec3(box.last) + 1.0, side));
        const glm::dvec3 voxel = to_voxel_coordinates(grid, at_mm);
        low = glm::min(low, voxel);
        high = glm::max(high, voxel);
    }
    low = glm::max(low, glm::dvec3(0.0));
    high = glm::min(high, glm::dvec3(grid.size_voxels - 1));
    if (glm::any(glm::greaterThan(low, high))) return std::nullopt;
    return VoxelBounds{glm::ivec3(low) / brick_edge_voxels, glm::ivec3(high) / brick_edge_voxels};
}

/// Where the segmentation's voxel (0, 0, 0) lies in the grid, if its voxels are the grid's.
std::optional<glm::ivec3> place_on_lattice(const SourceImage& image, const Grid& grid) {
    constexpr double of_a_voxel = 1e-3;
    const glm::dvec3 first = to_voxel_coordinates(grid, image.origin_mm);
    const glm::dvec3 last = to_voxel_coordinates(grid, position_mm(image, glm::dvec3(image.size_voxels - 1)));
    const glm::dvec3 place = glm::round(first);
    if (image.direction != glm::dmat3(1.0) ||
        glm::any(glm::greaterThan(glm::abs(first - place), glm::dvec3(of_a_voxel))) ||
        glm::any(glm::greaterThan(glm::abs(last - place - glm::dvec3(image.size_voxels - 1)),
                                  glm::dvec3(of_a_voxel))))
        return std::nullopt;
    return glm::ivec3(place);
}

StructureMask on_lattice(const SegmentVoxels& voxels, const ImageBox& box, const glm::ivec3& place,
                         const Grid& grid) {
    const glm::ivec3 size = size_in_bricks(grid);
    std::map<BrickIndex, VoxelMask> found;
    glm::ivec3 voxel;
    for (voxel.z = box.first.z; voxel.z <= box.last.z; ++voxel.z)
        for (voxel.y = box.first.y; voxel.y <= box.last.y; ++voxel.y)
            for (voxel.x = box.first.x; voxel.x <= box.last.x; ++voxel.x) {
                const glm::ivec3 at = voxel + place;
                if (!voxels(voxel) || glm::any(glm::lessThan(at, glm::ivec3(0))) ||
                    glm::any(glm::greaterThanEqual(at, grid.size_voxels)))
                    continue;
                found[brick_index(size, at / brick_edge_voxels)].set(offset_in_brick(at % brick_edge_voxels));
            }
    std::vector<StructureBrick> bricks;
    for (const auto& [brick, mask] : found) bricks.push_back({brick, mask});
    return {grid, std::move(bricks)};
}

}  // namespace

StructureMask structure_of(const Segmentation& segmentation, const Segment& segment, const Grid& grid) {
    require_valid(grid);
    const SegmentVoxels voxels(segmentation, segment);
    const std::optional<ImageBox> bounds = voxels.bounds();
    const SourceImage& image = segmentation.image;
    if (const auto place = place_on_lattice(image, grid); place && bounds)
        return on_lattice(voxels, *bounds, *place, grid);
    const std::optional<VoxelBounds> bricks =
        bounds ? bricks_over(image, *bounds, grid) : std::optional<VoxelBounds>();
    if (!bricks) return {grid, {}};

    Grid part_grid{.size_voxels = glm::min((bricks->last + 1) * brick_edge_voxels, grid.size_voxels) -
                                  bricks->first * brick_edge_voxels,
                   .spacing_mm = grid.spacing_mm,
                   .origin_mm = centre_of_voxel_mm(grid, bricks->first * brick_edge_voxels)};
    const glm::dvec3 end_mm = centre_of_voxel_mm(part_grid, part_grid.size_voxels - 1);
    const double finest_mm = std::min({image.spacing_mm.x, image.spacing_mm.y, image.spacing_mm.z});
    const int margin = refine_margin_voxels + static_cast<int>(2.0 * grid.spacing_mm / finest_mm);
    const ImageBox reach = voxels_for(image, {part_grid.origin_mm, end_mm}, glm::ivec3(margin));
    const ImageBox box{glm::max(reach.first, bounds->first - margin),
                       glm::min(reach.last, bounds->last + margin)};
    if (glm::any(glm::greaterThan(box.first, box.last))) return {grid, {}};

    std::vector<float> values(voxel_count(box));
    std::vector<float> slice(static_cast<std::size_t>(image.size_voxels.x) *
                             static_cast<std::size_t>(image.size_voxels.y));
    for (int k = box.first.z; k <= box.last.z; ++k) {
        std::ranges::fill(slice, 0.0F);
        for (int j = box.first.y; j <= box.last.y; ++j)
            for (int i = box.first.x; i <= box.last.x; ++i)
                if (voxels({i, j, k}))
                    slice[static_cast<std::size_t>(i) + static_cast<std::size_t>(image.size_voxels.x) *
                                                            static_cast<std::size_t>(j)] = inside;
        put_slice(image, box, k, slice, values);
    }
    const Refiner refiner(part_of(image, box), values, part_grid);

    const glm::ivec3 size = size_in_bricks(grid);
    const glm::ivec3 count = bricks->last - bricks->first + 1;
    std::vector<std::vector<StructureBrick>> layers(static_cast<std::size_t>(count.z));
    in_parallel(count.z, [&](int layer) {
        std::vector<StructureBrick>& out = layers[static_cast<std::size_t>(layer)];
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x)
                out.push_back({brick_index(size, bricks->first + glm::ivec3(x, y, layer)), {}});
        std::vector<std::int16_t> refined(static_cast<std::size_t>(part_grid.size_voxels.x) *
                                          static_cast<std::size_t>(part_grid.size_voxels.y));
        const int end = std::min((layer + 1) * brick_edge_voxels, part_grid.size_voxels.z);
        for (int z = layer * brick_edge_voxels; z < end; ++z) {
            refiner.slice(z, refined);
            auto value = refined.begin();
            for (int y = 0; y < part_grid.size_voxels.y; ++y)
                for (int x = 0; x < part_grid.size_voxels.x; ++x)
                    if (*value++ >= on_the_surface)
                        out[static_cast<std::size_t>(x / brick_edge_voxels +
                                                     count.x * (y / brick_edge_voxels))]
                            .voxels.set(offset_in_brick({x, y, z}));
        }
        std::erase_if(out, [](const StructureBrick& brick) { return brick.voxels.none(); });
    });
    std::vector<StructureBrick> all;
    for (const auto& layer : layers) all.insert(all.end(), layer.begin(), layer.end());
    return {grid, std::move(all)};
}

}  // namespace osteomill
