#include "common/bone/bone_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace osteomill {

namespace {

void require_positive(double value, const char* what) {
    if (!(std::isfinite(value) && value > 0.0))
        throw std::invalid_argument(std::string(what) + " is " + std::to_string(value) + ", not above zero");
}

/// Moves `bricks` into the order that `order` gives by old position.
std::vector<ByteBrick> reordered(std::vector<ByteBrick> bricks, const std::vector<std::size_t>& order) {
    if (std::is_sorted(order.begin(), order.end())) return bricks;
    std::vector<ByteBrick> sorted;
    sorted.reserve(bricks.size());
    if (bricks.empty()) return sorted;
    for (const std::size_t old : order) sorted.push_back(bricks[old]);
    return sorted;
}

bool reaches_past_grid(const Grid& grid, const glm::ivec3& brick, const ByteBrick& fraction) {
    const glm::ivec3 first = brick * brick_edge_voxels;
    if (contains(grid, first + (brick_edge_voxels - 1))) return false;
    for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel) {
        const auto offset = static_cast<int>(voxel);
        const glm::ivec3 place = first + glm::ivec3(offset % 16, offset / 16 % 16, offset / 256);
        if (fraction[voxel] != 0 && !contains(grid, place)) return true;
    }
    return false;
}

}  // namespace

BoneBuilder::BoneBuilder(const Grid& grid) {
    require_valid(grid);
    content_.grid = grid;
    content_.size_bricks = size_in_bricks(grid);
    const auto bricks =
        static_cast<std::size_t>(content_.size_bricks.x) * content_.size_bricks.y * content_.size_bricks.z;
    content_.slot_of_brick.assign(bricks, BoneContent::no_slot);
}

BoneBuilder BoneBuilder::homogeneous(const Grid& grid, double relative_stiffness, bool labelled) {
    require_positive(relative_stiffness, "relative stiffness");
    BoneBuilder builder(grid);
    builder.content_.homogeneous_stiffness = relative_stiffness;
    builder.labelled_ = labelled;
    return builder;
}

BoneBuilder BoneBuilder::heterogeneous(const Grid& grid, double stiffness_per_code, bool labelled) {
    require_positive(stiffness_per_code, "stiffness per code");
    BoneBuilder builder(grid);
    builder.content_.stiffness_per_code = stiffness_per_code;
    builder.heterogeneous_ = true;
    builder.labelled_ = labelled;
    return builder;
}

void BoneBuilder::add_brick(const glm::ivec3& brick, const ByteBrick& fraction, const ByteBrick* stiffness,
                            const ByteBrick* tissue) {
    for (int axis = 0; axis < 3; ++axis)
        if (brick[axis] < 0 || brick[axis] >= content_.size_bricks[axis])
            throw std::invalid_argument("brick " + std::to_string(brick[axis]) + " along axis " +
                                        std::to_string(axis) + " lies outside the grid's " +
                                        std::to_string(content_.size_bricks[axis]));
    if ((heterogeneous_ && stiffness == nullptr) || (labelled_ && tissue == nullptr))
        throw std::invalid_argument("a brick lacks a channel that the bone has");
    if (std::all_of(fraction.begin(), fraction.end(), [](std::uint8_t f) { return f == 0; })) return;
    if (reaches_past_grid(content_.grid, brick, fraction))
        throw std::invalid_argument("a brick at the grid's edge holds bone past it");

    const BrickIndex index = brick_index(content_.size_bricks, brick);
    if (content_.slot_of_brick[index] != BoneContent::no_slot)
        throw std::invalid_argument("brick " + std::to_string(index) + " was added twice");
    content_.slot_of_brick[index] = static_cast<std::int32_t>(fraction_.size());
    content_.brick_of_slot.push_back(index);
    fraction_.push_back(fraction);
    if (heterogeneous_) content_.stiffness.push_back(*stiffness);
    if (labelled_) content_.tissue.push_back(*tissue);
}

Bone BoneBuilder::build() && {
    std::vector<std::size_t> order(content_.brick_of_slot.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return content_.brick_of_slot[a] < content_.brick_of_slot[b];
    });
    fraction_ = reordered(std::move(fraction_), order);
    content_.stiffness = reordered(std::move(content_.stiffness), order);
    content_.tissue = reordered(std::move(content_.tissue), order);
    std::sort(content_.brick_of_slot.begin(), content_.brick_of_slot.end());
    for (std::size_t slot = 0; slot < content_.brick_of_slot.size(); ++slot)
        content_.slot_of_brick[content_.brick_of_slot[slot]] = static_cast<std::int32_t>(slot);
    fraction_.shrink_to_fit();
    content_.brick_of_slot.shrink_to_fit();
    content_.stiffness.shrink_to_fit();
    content_.tissue.shrink_to_fit();
    return Bone(std::make_shared<const BoneContent>(std::move(content_)), std::move(fraction_));
}

}  // namespace osteomill
