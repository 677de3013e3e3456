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

/// Positions of `bricks` in ascending order of the bricks there.
std::vector<std::size_t> ascending(const std::vector<BrickIndex>& bricks) {
    std::vector<std::size_t> order(bricks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return bricks[a] < bricks[b]; });
    return order;
}

/// Brings a channel, if there is one, into the order that `order` gives by old position: cycle by cycle, so
/// that no second channel is needed.
template <typename Value>
void reorder(std::vector<Value>& channel, const std::vector<std::size_t>& order) {
    if (channel.empty()) return;
    std::vector<bool> is_done(order.size(), false);
    for (std::size_t start = 0; start < order.size(); ++start) {
        if (is_done[start]) continue;
        const Value first = channel[start];
        std::size_t place = start;
        for (; order[place] != start; place = order[place]) {
            channel[place] = channel[order[place]];
            is_done[place] = true;
        }
        channel[place] = first;
        is_done[place] = true;
    }
}

bool reaches_past_grid(const Grid& grid, const glm::ivec3& brick, const ByteBrick& fraction) {
    const glm::ivec3 first = brick * brick_edge_voxels;
    if (contains(grid, first + (brick_edge_voxels - 1))) return false;
    for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
        if (fraction[voxel] != 0 && !contains(grid, first + voxel_in_brick(voxel))) return true;
    return false;
}

/// 64 MiB: malloc asks the system for such a piece by itself and gives it back when it is freed.
constexpr std::size_t bricks_of_piece = 16384;

}  // namespace

void BrickPieces::reserve(std::size_t count) {
    if (pieces_.empty()) pieces_.emplace_back();
    if (pieces_.size() == 1) pieces_.front().reserve(count);
}

void BrickPieces::push_back(const ByteBrick& brick) {
    if (pieces_.empty() || pieces_.back().size() == pieces_.back().capacity())
        pieces_.emplace_back().reserve(bricks_of_piece);
    pieces_.back().push_back(brick);
}

std::vector<ByteBrick> BrickPieces::take() {
    if (pieces_.empty()) return {};
    std::vector<ByteBrick> all;
    if (pieces_.size() == 1) {
        all = std::move(pieces_.front());
    } else {
        std::size_t count = 0;
        for (const std::vector<ByteBrick>& piece : pieces_) count += piece.size();
        all.reserve(count);
        for (std::vector<ByteBrick>& piece : pieces_) {
            all.insert(all.end(), piece.begin(), piece.end());
            std::vector<ByteBrick>().swap(piece);
        }
    }
    pieces_.clear();
    return all;
}

BoneBuilder::BoneBuilder(const Grid& grid) {
    require_valid(grid);
    content_.grid = grid;
    content_.size_bricks = size_in_bricks(grid);
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

void BoneBuilder::reserve_bricks(std::size_t count) {
    content_.brick_of_slot.reserve(count);
    fraction_.reserve(count);
    if (heterogeneous_) stiffness_.reserve(count);
    if (labelled_) tissue_.reserve(count);
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

    content_.brick_of_slot.push_back(brick_index(content_.size_bricks, brick));
    fraction_.push_back(fraction);
    if (heterogeneous_) stiffness_.push_back(*stiffness);
    if (labelled_) tissue_.push_back(*tissue);
}

void BoneBuilder::make_heterogeneous(double stiffness_per_code, std::uint8_t code) {
    require_positive(stiffness_per_code, "stiffness per code");
    if (heterogeneous_) throw std::logic_error("the bone is heterogeneous already");
    heterogeneous_ = true;
    content_.homogeneous_stiffness = BoneContent{}.homogeneous_stiffness;
    content_.stiffness_per_code = stiffness_per_code;
    fraction_.for_each([&](const ByteBrick& fraction) {
        ByteBrick codes{};
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            codes[voxel] = fraction[voxel] == 0 ? std::uint8_t{0} : code;
        stiffness_.push_back(codes);
    });
}

Bone BoneBuilder::build() && {
    std::vector<ByteBrick> fraction = fraction_.take();
    content_.stiffness = stiffness_.take();
    content_.tissue = tissue_.take();
    if (!std::is_sorted(content_.brick_of_slot.begin(), content_.brick_of_slot.end())) {
        const std::vector<std::size_t> order = ascending(content_.brick_of_slot);
        reorder(fraction, order);
        reorder(content_.stiffness, order);
        reorder(content_.tissue, order);
        reorder(content_.brick_of_slot, order);
    }
    content_.slot_of_brick = BrickTable(content_.brick_of_slot);
    return Bone(std::make_shared<const BoneContent>(std::move(content_)), std::move(fraction));
}

}  // namespace osteomill
