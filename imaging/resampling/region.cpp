#include "imaging/resampling/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>

#include "common/text/words.h"

namespace osteomill {

ScanRegion extent_of(const SourceImage& image) {
    ScanRegion extent{.low_mm = image.origin_mm, .high_mm = image.origin_mm};
    const glm::dvec3 last = glm::dvec3(image.size_voxels - 1);
    for (int corner = 1; corner < 8; ++corner) {
        const glm::dvec3 at =
            position_mm(image, last * glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1));
        extent.low_mm = glm::min(extent.low_mm, at);
        extent.high_mm = glm::max(extent.high_mm, at);
    }
    return extent;
}

ScanRegion parse_region(const std::string& text) {
    const auto refuse = [&](const char* why) {
        throw std::invalid_argument(
            fmt::format("--region '{}': {}; it is x0,y0,z0,x1,y1,z1 in mm of patient LPS", text, why));
    };
    const auto numbers = listed_numbers<6>(text);
    if (!numbers) refuse("not six numbers");
    const auto& [x0, y0, z0, x1, y1, z1] = *numbers;
    const ScanRegion region{.low_mm = {x0, y0, z0}, .high_mm = {x1, y1, z1}};
    if (!glm::all(glm::lessThan(region.low_mm, region.high_mm)))
        refuse("its second corner must be above its first");
    return region;
}

ScanRegion clip(const ScanRegion& region, const ScanRegion& extent) {
    const ScanRegion common{.low_mm = glm::max(region.low_mm, extent.low_mm),
                            .high_mm = glm::min(region.high_mm, extent.high_mm)};
    if (!glm::all(glm::lessThan(common.low_mm, common.high_mm)))
        throw std::invalid_argument(
            fmt::format("--region {} lies outside the image, which covers {} (mm, patient LPS)",
                        to_text(region), to_text(extent)));
    return common;
}

std::string to_text(const ScanRegion& region) {
    return fmt::format("{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f}", region.low_mm.x, region.low_mm.y,
                       region.low_mm.z, region.high_mm.x, region.high_mm.y, region.high_mm.z);
}

Grid grid_over(const ScanRegion& region, double spacing_mm) {
    // A centre that rounding puts just outside the region still belongs to it.
    constexpr double rounding_voxels = 1e-6;
    const glm::dvec3 count =
        glm::floor((region.high_mm - region.low_mm) / spacing_mm + rounding_voxels) + 1.0;
    for (int axis = 0; axis < 3; ++axis)
        if (!(count[axis] <= 65536.0))
            throw std::invalid_argument(fmt::format(
                "{:.0f} voxels of {} mm along one axis are too many (at most 65536); use --region or a "
                "larger --spacing-mm",
                count[axis], spacing_mm));
    return {.size_voxels = glm::ivec3(count), .spacing_mm = spacing_mm, .origin_mm = region.low_mm};
}

namespace {

/// Off an axis by less than this is how directions are printed: over 500 mm it moves a voxel by 0.05 mm.
constexpr double alignment_tolerance = 1e-4;

/// Which axis of the source each axis of the part follows, and whether backwards.
struct Turn {
    glm::ivec3 axis{0, 1, 2};
    glm::ivec3 sign{1, 1, 1};
};

Turn turn_to_lps(const SourceImage& image) {
    Turn turn;
    for (int source = 0; source < 3; ++source)
        for (int lps = 0; lps < 3; ++lps)
            if (std::abs(image.direction[source][lps]) > 0.5) {
                turn.axis[lps] = source;
                turn.sign[lps] = image.direction[source][lps] > 0.0 ? 1 : -1;
            }
    return turn;
}

}  // namespace

ImageBox voxels_for(const SourceImage& image, const ScanRegion& region, const glm::ivec3& margin_voxels) {
    glm::dvec3 low(1e30);
    glm::dvec3 high(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at = voxel_at(image, {corner & 1 ? region.high_mm.x : region.low_mm.x,
                                               corner & 2 ? region.high_mm.y : region.low_mm.y,
                                               corner & 4 ? region.high_mm.z : region.low_mm.z});
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec3 end = glm::dvec3(image.size_voxels - 1);
    return {
        .first = glm::ivec3(glm::clamp(glm::floor(low) - glm::dvec3(margin_voxels), glm::dvec3(0.0), end)),
        .last = glm::ivec3(glm::clamp(glm::ceil(high) + glm::dvec3(margin_voxels), glm::dvec3(0.0), end))};
}

std::uint64_t voxel_count(const ImageBox& box) {
    const glm::ivec3 size = box.last - box.first + 1;
    return static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
           static_cast<std::uint64_t>(size.z);
}

bool is_axis_aligned(const SourceImage& image) {
    for (int source = 0; source < 3; ++source)
        for (int lps = 0; lps < 3; ++lps) {
            const double cosine = std::abs(image.direction[source][lps]);
            if (cosine > alignment_tolerance && std::abs(cosine - 1.0) > alignment_tolerance) return false;
        }
    return true;
}

SourceImage part_of(const SourceImage& image, const ImageBox& box) {
    const bool aligned = is_axis_aligned(image);
    const Turn turn = aligned ? turn_to_lps(image) : Turn{};
    const glm::ivec3 box_size = box.last - box.first + 1;
    SourceImage part;
    glm::ivec3 start{0};  // the part's voxel (0, 0, 0) in the source
    for (int axis = 0; axis < 3; ++axis) {
        const int source = turn.axis[axis];
        part.size_voxels[axis] = box_size[source];
        part.spacing_mm[axis] = image.spacing_mm[source];
        start[source] = turn.sign[axis] > 0 ? box.first[source] : box.last[source];
    }
    part.direction = aligned ? glm::dmat3(1.0) : image.direction;
    part.origin_mm = position_mm(image, glm::dvec3(start));
    return part;
}

void put_slice(const SourceImage& image, const ImageBox& box, int k, std::span<const float> slice,
               std::span<float> part_values) {
    if (k < box.first.z || k > box.last.z) return;
    const Turn turn = is_axis_aligned(image) ? turn_to_lps(image) : Turn{};
    const glm::ivec3 box_size = box.last - box.first + 1;
    std::ptrdiff_t step[3];  // in the part, of a step along each axis of the source
    std::ptrdiff_t origin = 0;
    std::ptrdiff_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int source = turn.axis[axis];
        step[source] = stride * turn.sign[axis];
        if (turn.sign[axis] < 0) origin += stride * (box_size[source] - 1);
        stride *= box_size[source];
    }
    origin += step[2] * (k - box.first.z);
    for (int j = 0; j < box_size.y; ++j) {
        const float* from =
            slice.data() + static_cast<std::ptrdiff_t>(image.size_voxels.x) * (box.first.y + j) + box.first.x;
        float* to = part_values.data() + origin + step[1] * j;
        for (int i = 0; i < box_size.x; ++i) to[step[0] * i] = from[i];
    }
}

}  // namespace osteomill
