#include "slicer/reduced_bone.h"

#include <algorithm>
#include <glm/common.hpp>

namespace osteomill {

namespace {

int factor_of(const Grid& grid) {
    const int longest = std::max({grid.size_voxels.x, grid.size_voxels.y, grid.size_voxels.z});
    return (longest + ReducedBone::most_voxels - 1) / ReducedBone::most_voxels;
}

Grid reduced(const Grid& grid, int factor) {
    return {.size_voxels = (grid.size_voxels + (factor - 1)) / factor,
            .spacing_mm = factor * grid.spacing_mm,
            .origin_mm = grid.origin_mm + glm::dvec3(0.5 * (factor - 1) * grid.spacing_mm)};
}

std::size_t index_of(const Grid& grid, const glm::ivec3& voxel) {
    const auto nx = static_cast<std::size_t>(grid.size_voxels.x);
    const auto ny = static_cast<std::size_t>(grid.size_voxels.y);
    return static_cast<std::size_t>(voxel.x) +
           nx * (static_cast<std::size_t>(voxel.y) + ny * static_cast<std::size_t>(voxel.z));
}

/// Calls `visit(voxel)` in the order in which values are stored.
template <typename Visit>
void for_each_voxel(const ReducedBox& box, const Visit& visit) {
    for (int z = box.first.z; z < box.end.z; ++z)
        for (int y = box.first.y; y < box.end.y; ++y)
            for (int x = box.first.x; x < box.end.x; ++x) visit(glm::ivec3(x, y, z));
}

/// Mean of `factor`^3 voxels; those beyond the grid are empty.
std::uint8_t mean_fraction(const Bone& bone, const glm::ivec3& first, int factor) {
    int sum = 0;
    for_each_voxel({first, first + factor}, [&](const glm::ivec3& voxel) { sum += bone.fraction_at(voxel); });
    const int count = factor * factor * factor;
    return static_cast<std::uint8_t>((sum + count / 2) / count);
}

}  // namespace

ReducedBox around(const ReducedBox& a, const ReducedBox& b) {
    return {glm::min(a.first, b.first), glm::max(a.end, b.end)};
}

ReducedBone::ReducedBone(const Bone& bone)
    : factor_(factor_of(bone.grid())), grid_(reduced(bone.grid(), factor_)) {
    values_.resize(index_of(grid_, grid_.size_voxels - 1) + 1);
    for (const BrickIndex brick : bone.content().brick_of_slot)
        fill(bone, voxels_of(brick_position(bone.content().size_bricks, brick)));
}

ReducedBox ReducedBone::voxels_of(const glm::ivec3& brick) const {
    const glm::ivec3 first = brick * brick_edge_voxels;
    return {first / factor_,
            glm::min((first + (brick_edge_voxels + factor_ - 1)) / factor_, grid_.size_voxels)};
}

void ReducedBone::fill(const Bone& bone, const ReducedBox& box) {
    for_each_voxel(box, [&](const glm::ivec3& voxel) {
        values_[index_of(grid_, voxel)] = mean_fraction(bone, voxel * factor_, factor_);
    });
}

std::vector<std::uint8_t> ReducedBone::values(const ReducedBox& box) const {
    const glm::ivec3 size = box.size();
    std::vector<std::uint8_t> found;
    found.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                  static_cast<std::size_t>(size.z));
    for_each_voxel(box, [&](const glm::ivec3& voxel) { found.push_back(values_[index_of(grid_, voxel)]); });
    return found;
}

std::optional<ReducedBox> ReducedBone::update(const Bone& bone, std::span<const BrickChange> changes) {
    std::optional<ReducedBox> changed;
    for (const BrickChange& change : changes) {
        const ReducedBox box = voxels_of(brick_position(bone.content().size_bricks, change.brick));
        fill(bone, box);
        changed = changed ? around(*changed, box) : box;
    }
    return changed;
}

}  // namespace osteomill
