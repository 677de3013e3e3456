#include "haptic_server/imaging/image_part.h"

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

VoxelBox voxels_for(const SourceImage& image, const Region& region, int margin_voxels) {
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
    return {.first = glm::ivec3(glm::clamp(glm::floor(low) - double(margin_voxels), glm::dvec3(0.0), end)),
            .last = glm::ivec3(glm::clamp(glm::ceil(high) + double(margin_voxels), glm::dvec3(0.0), end))};
}

std::uint64_t voxel_count(const VoxelBox& box) {
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

SourceImage cut(const SourceImage& image, const VoxelBox& box) {
    const bool aligned = is_axis_aligned(image);
    const Turn turn = aligned ? turn_to_lps(image) : Turn{};
    const glm::ivec3 box_size = box.last - box.first + 1;
    const glm::dvec3 steps{1.0, image.size_voxels.x,
                           static_cast<double>(image.size_voxels.x) * image.size_voxels.y};

    SourceImage part;
    glm::ivec3 start{0};  // the part's voxel (0, 0, 0) in the source
    std::ptrdiff_t step[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int source = turn.axis[axis];
        part.size_voxels[axis] = box_size[source];
        part.spacing_mm[axis] = image.spacing_mm[source];
        start[source] = turn.sign[axis] > 0 ? box.first[source] : box.last[source];
        step[axis] = static_cast<std::ptrdiff_t>(steps[source]) * turn.sign[axis];
    }
    part.direction = aligned ? glm::dmat3(1.0) : image.direction;
    part.origin_mm = position_mm(image, glm::dvec3(start));
    part.values.reserve(voxel_count(part));
    const std::ptrdiff_t first =
        start.x + static_cast<std::ptrdiff_t>(image.size_voxels.x) *
                      (start.y + static_cast<std::ptrdiff_t>(image.size_voxels.y) * start.z);
    for (int z = 0; z < part.size_voxels.z; ++z)
        for (int y = 0; y < part.size_voxels.y; ++y)
            for (int x = 0; x < part.size_voxels.x; ++x)
                part.values.push_back(
                    image.values[static_cast<std::size_t>(first + x * step[0] + y * step[1] + z * step[2])]);
    return part;
}

}  // namespace osteomill
