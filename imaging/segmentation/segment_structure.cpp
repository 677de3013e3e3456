#include "imaging/segmentation/segment_structure.h"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "imaging/in_parallel.h"
#include "imaging/resampling/refine.h"
#include "imaging/resampling/region.h"

namespace osteomill {

namespace {

constexpr float inside = 1000.0F;
constexpr std::int16_t half = 500;
constexpr std::int16_t least_level = 250;

/// Smallest box round a segment's voxels.
std::optional<ImageBox> bounds_of(const Segmentation& segmentation, const Segment& segment) {
    ImageBox box{glm::ivec3(std::numeric_limits<int>::max()), glm::ivec3(-1)};
    segmentation.labels.for_each_run(segment.layer, segment.label, [&](int first, int end, int j, int k) {
        box.first = glm::min(box.first, glm::ivec3(first, j, k));
        box.last = glm::max(box.last, glm::ivec3(end - 1, j, k));
    });
    if (box.last.x < 0) return std::nullopt;
    return box;
}

/// The part of the bone's grid that the box may reach, with a margin of a voxel of the scan, in whole bricks.
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

/// The grid's voxel at the segmentation's voxel (0, 0, 0), if the segmentation's voxels are the grid's.
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

/// The same with so many voxels more on every side, in which nothing is labelled: a file may be cut as close
/// as its segments go, and its last voxels must not go on beyond it.
SourceImage padded_by(int margin, SourceImage image) {
    image.origin_mm = position_mm(image, glm::dvec3(-margin));
    image.size_voxels += 2 * margin;
    return image;
}

StructureMask on_lattice(const Segmentation& segmentation, const Segment& segment, const glm::ivec3& place,
                         const Grid& grid) {
    const glm::ivec3 size = size_in_bricks(grid);
    std::map<BrickIndex, VoxelMask> found;
    std::vector<VoxelMask*> masks(static_cast<std::size_t>(size.x));  // a row of bricks, if known
    glm::ivec2 row_of_masks(-1);
    segmentation.labels.for_each_run(segment.layer, segment.label, [&](int first, int end, int j, int k) {
        const glm::ivec2 row(j + place.y, k + place.z);
        if (glm::any(glm::lessThan(row, glm::ivec2(0))) ||
            glm::any(glm::greaterThanEqual(row, glm::ivec2(grid.size_voxels.y, grid.size_voxels.z))))
            return;
        if (row / brick_edge_voxels != row_of_masks) {
            row_of_masks = row / brick_edge_voxels;
            std::ranges::fill(masks, nullptr);
        }
        const int last = std::min(end + place.x, grid.size_voxels.x);
        for (int x = std::max(first + place.x, 0); x < last;) {
            const int brick = x / brick_edge_voxels;
            const int past = std::min(last, (brick + 1) * brick_edge_voxels);
            VoxelMask*& mask = masks[static_cast<std::size_t>(brick)];
            if (mask == nullptr) mask = &found[brick_index(size, {brick, row_of_masks.x, row_of_masks.y})];
            mask->set_run(offset_in_brick(glm::ivec3(x, row.x, row.y) % brick_edge_voxels),
                          static_cast<std::size_t>(past - x));
            x = past;
        }
    });
    std::vector<StructureBrick> bricks;
    for (const auto& [brick, mask] : found) bricks.push_back({brick, mask});
    return {grid, std::move(bricks)};
}

/// The segment's voxels whose centre lies in the grid, counted in voxels of the grid.
double voxels_within(const Segmentation& segmentation, const Segment& segment, const Grid& grid) {
    const SourceImage& image = segmentation.image;
    const glm::dvec3 end = glm::dvec3(grid.size_voxels) - 0.5;
    std::uint64_t count = 0;
    segmentation.labels.for_each_run(segment.layer, segment.label, [&](int first, int last, int j, int k) {
        for (int i = first; i < last; ++i) {
            const glm::dvec3 at = to_voxel_coordinates(grid, position_mm(image, glm::dvec3(i, j, k)));
            count += glm::all(glm::greaterThanEqual(at, glm::dvec3(-0.5))) && glm::all(glm::lessThan(at, end))
                         ? 1
                         : 0;
        }
    });
    return static_cast<double>(count) * image.spacing_mm.x * image.spacing_mm.y * image.spacing_mm.z /
           voxel_volume_mm3(grid);
}

/// The value at which to cut, so that the inside is as large as the segment. A half would make round, thin
/// shapes too small, a rod of four voxels by 2 %. Never above a half: two segments side by side would leave a
/// gap.
std::int16_t level_of(const Refiner& refiner, const Grid& grid, double wanted_voxels) {
    std::vector<std::uint64_t> with_value(half + 1);  // larger values count as a half
    std::mutex mutex;
    in_parallel(grid.size_voxels.z, [&](int z) {
        std::vector<std::int16_t> refined(static_cast<std::size_t>(grid.size_voxels.x) *
                                          static_cast<std::size_t>(grid.size_voxels.y));
        refiner.slice(z, refined);
        std::vector<std::uint64_t> here(with_value.size());
        for (const std::int16_t value : refined)
            ++here[static_cast<std::size_t>(std::clamp(value, std::int16_t{0}, half))];
        const std::lock_guard lock(mutex);
        std::ranges::transform(here, with_value, with_value.begin(), std::plus<>());
    });
    std::int16_t level = half;
    double counted = static_cast<double>(with_value[half]);
    while (level > least_level) {
        const double more = counted + static_cast<double>(with_value[static_cast<std::size_t>(level - 1)]);
        if (wanted_voxels - counted <= more - wanted_voxels) break;
        counted = more;
        --level;
    }
    return level;
}

}  // namespace

StructureMask structure_of(const Segmentation& segmentation, const Segment& segment, const Grid& grid) {
    require_valid(grid);
    const std::optional<ImageBox> bounds = bounds_of(segmentation, segment);
    const SourceImage& stored = segmentation.image;
    if (const auto place = place_on_lattice(stored, grid); place && bounds)
        return on_lattice(segmentation, segment, *place, grid);
    const std::optional<VoxelBounds> bricks =
        bounds ? bricks_over(stored, *bounds, grid) : std::optional<VoxelBounds>();
    if (!bricks) return {grid, {}};

    Grid part_grid{.size_voxels = glm::min((bricks->last + 1) * brick_edge_voxels, grid.size_voxels) -
                                  bricks->first * brick_edge_voxels,
                   .spacing_mm = grid.spacing_mm,
                   .origin_mm = centre_of_voxel_mm(grid, bricks->first * brick_edge_voxels)};
    const glm::dvec3 end_mm = centre_of_voxel_mm(part_grid, part_grid.size_voxels - 1);
    const double finest_mm = std::min({stored.spacing_mm.x, stored.spacing_mm.y, stored.spacing_mm.z});
    const int margin = refine_margin_voxels + static_cast<int>(2.0 * grid.spacing_mm / finest_mm);
    const SourceImage image = padded_by(margin, stored);
    const ImageBox reach = voxels_for(image, {part_grid.origin_mm, end_mm}, glm::ivec3(margin));
    const ImageBox box{glm::max(reach.first, bounds->first), glm::min(reach.last, bounds->last + 2 * margin)};
    if (glm::any(glm::greaterThan(box.first, box.last))) return {grid, {}};

    std::vector<float> values(voxel_count(box));
    std::vector<float> slice(static_cast<std::size_t>(image.size_voxels.x) *
                             static_cast<std::size_t>(image.size_voxels.y));
    for (int k = box.first.z; k <= box.last.z; ++k) {
        std::ranges::fill(slice, 0.0F);
        const int first_row = std::max(box.first.y - margin, 0);
        const int past_row = std::min(box.last.y - margin + 1, stored.size_voxels.y);
        for (int j = first_row; k >= margin && k - margin < stored.size_voxels.z && j < past_row; ++j) {
            const auto row =
                slice.begin() + static_cast<std::ptrdiff_t>(image.size_voxels.x) * (j + margin) + margin;
            std::int32_t first = 0;
            for (const LabelRows::Run& run : segmentation.labels.row(segment.layer, j, k - margin)) {
                if (run.label == segment.label) std::fill(row + first, row + run.end, inside);
                first = run.end;
            }
        }
        put_slice(image, box, k, slice, values);
    }
    const Refiner refiner(part_of(image, box), values, part_grid);
    const std::int16_t level = level_of(refiner, part_grid, voxels_within(segmentation, segment, part_grid));

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
                    if (*value++ >= level)
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
