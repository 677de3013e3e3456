#include "imaging/resampling/image_part.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace osteomill {

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
