#include "common/bone/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <stdexcept>
#include <string>

namespace osteomill {

namespace {

constexpr std::uint16_t far = std::numeric_limits<std::uint16_t>::max();
/// Farthest that a corner of the cell about a point within reach may lie beyond the reach (a cube's
/// diagonal).
constexpr double cell_voxels = 1.75;
/// Once the list of bricks has grown by so many, duplicates are removed.
constexpr std::size_t bricks_before_sorting = 1u << 20;

/// Lower envelope of parabolas, in half voxels: the value that every voxel of a line gets from the faces
/// between voxels. A face lies at 2j + 1 between voxels j and j + 1, with the lesser of their values; a voxel
/// is at 2j.
class LineTransform {
  public:
    void operator()(std::vector<std::uint16_t>& line, std::uint32_t most_square) {
        const int count = static_cast<int>(line.size());
        faces_.clear();
        const auto value = [&](int j) {
            return j < 0 || j >= count ? far : line[static_cast<std::size_t>(j)];
        };
        for (int j = -1; j < count; ++j) {
            const std::uint16_t height = std::min(value(j), value(j + 1));
            if (height != far) add(2 * j + 1, height);
        }
        if (faces_.empty()) return;
        std::size_t at = 0;
        for (int j = 0; j < count; ++j) {
            while (at + 1 < faces_.size() && faces_[at + 1].from <= 2.0 * j) ++at;
            const std::int64_t apart = 2 * j - faces_[at].place;
            const std::int64_t square = apart * apart + faces_[at].height;
            std::uint16_t& own = line[static_cast<std::size_t>(j)];
            if (square <= most_square) own = std::min(own, static_cast<std::uint16_t>(square));
        }
    }

  private:
    struct Face {
        int place;
        int height;
        double from;  // where its parabola begins to be the lowest
    };
    void add(int place, int height) {
        double from = -std::numeric_limits<double>::infinity();
        while (!faces_.empty()) {
            const Face& last = faces_.back();
            from = 0.5 * (place + last.place) + 0.5 * (height - last.height) / (place - last.place);
            if (from > last.from) break;
            faces_.pop_back();
        }
        if (faces_.empty()) from = -std::numeric_limits<double>::infinity();
        faces_.push_back({place, height, from});
    }
    std::vector<Face> faces_;
};

void sort_out(std::vector<BrickIndex>& bricks) {
    std::ranges::sort(bricks);
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
}

void require_room(std::size_t bricks) {
    if (bricks > DistanceField::most_bricks)
        throw std::length_error("distance field: takes more than " +
                                std::to_string(DistanceField::most_bricks) + " bricks");
}

/// Smallest box round the voxels of a brick, counted from its first.
VoxelBounds bounds_of(const VoxelMask& voxels) {
    VoxelBounds box{glm::ivec3(brick_edge_voxels), glm::ivec3(-1)};
    voxels.for_each([&](std::size_t offset) {
        box.first = glm::min(box.first, voxel_in_brick(offset));
        box.last = glm::max(box.last, voxel_in_brick(offset));
    });
    return box;
}

}  // namespace

DistanceField::DistanceField(const StructureMask& structure, double reach_mm) {
    if (!(reach_mm > 0.0) || !std::isfinite(reach_mm))
        throw std::invalid_argument("distance field: its reach must be a number of mm above 0");
    grid_ = structure.grid();
    reach_mm_ = std::min(reach_mm, most_reach_voxels * grid_.spacing_mm);
    if (structure.empty()) return;
    find_bricks(structure);
    const double half_voxels = 2.0 * (reach_mm_ / grid_.spacing_mm + cell_voxels);
    const auto most_square = static_cast<std::uint32_t>(half_voxels * half_voxels);
    for (int axis = 0; axis < 3; ++axis) transform_along(axis, most_square);
    drop_far_bricks();
}

void DistanceField::find_bricks(const StructureMask& structure) {
    const glm::ivec3 size = size_in_bricks(structure.grid());
    const double reach_voxels = reach_mm_ / grid_.spacing_mm + cell_voxels;
    const int margin = static_cast<int>(reach_voxels) / brick_edge_voxels + 1;
    const VoxelBounds bounds = *structure.bounds();
    const glm::ivec3 first = bounds.first / brick_edge_voxels - margin;
    size_bricks_ = bounds.last / brick_edge_voxels + margin - first + 1;
    if (static_cast<double>(size_bricks_.x) * size_bricks_.y * size_bricks_.z >
        std::numeric_limits<BrickIndex>::max())
        throw std::invalid_argument("distance field: spans too many bricks");
    grid_.origin_mm = centre_of_voxel_mm(grid_, first * brick_edge_voxels);
    grid_.size_voxels = size_bricks_ * brick_edge_voxels;
    std::size_t sorted = 0;
    for (const StructureBrick& one : structure.bricks()) {
        const glm::ivec3 here = brick_position(size, one.brick) - first;
        const VoxelBounds box = bounds_of(one.voxels);
        glm::ivec3 off;
        for (off.z = -margin; off.z <= margin; ++off.z)
            for (off.y = -margin; off.y <= margin; ++off.y)
                for (off.x = -margin; off.x <= margin; ++off.x) {
                    double squared = 0.0;
                    for (int axis = 0; axis < 3; ++axis) {
                        const int low = brick_edge_voxels * off[axis] - box.last[axis];
                        const int high = box.first[axis] - brick_edge_voxels * off[axis] - 15;
                        const double apart = std::max({low, high, 0});
                        squared += (apart - 0.5) * (apart - 0.5) * (apart > 0.0 ? 1.0 : 0.0);
                    }
                    if (squared <= reach_voxels * reach_voxels)
                        bricks_.push_back(brick_index(size_bricks_, here + off));
                }
        if (bricks_.size() > sorted + bricks_before_sorting) {
            sort_out(bricks_);
            require_room(bricks_.size());
            sorted = bricks_.size();
        }
    }
    sort_out(bricks_);
    require_room(bricks_.size());
    slot_of_brick_ = BrickTable(bricks_);
    squares_.resize(bricks_.size());
    for (SquareBrick& brick : squares_) brick.fill(far);
    for (const StructureBrick& one : structure.bricks()) {
        const glm::ivec3 here = brick_position(size, one.brick) - first;
        SquareBrick& brick =
            squares_[static_cast<std::size_t>(slot_of_brick_.find(brick_index(size_bricks_, here)))];
        one.voxels.for_each([&](std::size_t offset) { brick[offset] = 0; });
    }
}

// Voxels between two voxels of a line that are within reach of one another are within reach, too, so a line
// may end where no brick is.
void DistanceField::transform_along(int axis, std::uint32_t most_square) {
    constexpr std::array<std::size_t, 3> stride{1, 16, 256};
    const std::size_t step = stride[static_cast<std::size_t>(axis)];
    const std::size_t step_u = stride[static_cast<std::size_t>((axis + 1) % 3)];
    const std::size_t step_v = stride[static_cast<std::size_t>((axis + 2) % 3)];
    glm::ivec3 along(0);
    along[axis] = 1;
    LineTransform transform;
    std::vector<SquareBrick*> run;
    std::vector<std::uint16_t> line;
    for (std::size_t slot = 0; slot < bricks_.size(); ++slot) {
        glm::ivec3 position = brick_position(size_bricks_, bricks_[slot]);
        if (position[axis] > 0 &&
            slot_of_brick_.find(brick_index(size_bricks_, position - along)) != BrickTable::no_slot)
            continue;  // not where a run begins
        run.clear();
        for (; position[axis] < size_bricks_[axis]; position += along) {
            const std::int32_t found = slot_of_brick_.find(brick_index(size_bricks_, position));
            if (found == BrickTable::no_slot) break;
            run.push_back(&squares_[static_cast<std::size_t>(found)]);
        }
        line.resize(run.size() * brick_edge_voxels);
        for (std::size_t place = 0; place < brick_edge_voxels * brick_edge_voxels; ++place) {
            const std::size_t base = place % brick_edge_voxels * step_u + place / brick_edge_voxels * step_v;
            bool any = false;
            for (std::size_t i = 0; i < line.size(); ++i) {
                line[i] = (*run[i / brick_edge_voxels])[base + i % brick_edge_voxels * step];
                any = any || line[i] != far;
            }
            if (!any) continue;
            transform(line, most_square);
            for (std::size_t i = 0; i < line.size(); ++i)
                (*run[i / brick_edge_voxels])[base + i % brick_edge_voxels * step] = line[i];
        }
    }
}

void DistanceField::drop_far_bricks() {
    std::size_t kept = 0;
    for (std::size_t slot = 0; slot < bricks_.size(); ++slot) {
        if (std::ranges::all_of(squares_[slot], [](std::uint16_t square) { return square == far; })) continue;
        if (kept != slot) {
            bricks_[kept] = bricks_[slot];
            squares_[kept] = squares_[slot];
        }
        ++kept;
    }
    bricks_.resize(kept);
    squares_.resize(kept);
    squares_.shrink_to_fit();
    bricks_.shrink_to_fit();
    slot_of_brick_ = BrickTable(bricks_);
}

std::uint16_t DistanceField::square_at(const glm::ivec3& voxel) const noexcept {
    if (!contains(grid_, voxel)) return far;
    const std::int32_t slot = slot_of_brick_.find(brick_index(size_bricks_, voxel / brick_edge_voxels));
    return slot == BrickTable::no_slot ? far
                                       : squares_[static_cast<std::size_t>(slot)][offset_in_brick(voxel)];
}

std::optional<float> DistanceField::distance_mm(const glm::dvec3& position_mm) const noexcept {
    if (squares_.empty()) return std::nullopt;
    const glm::dvec3 place = to_voxel_coordinates(grid_, position_mm);
    for (int axis = 0; axis < 3; ++axis)
        if (!(place[axis] >= 0.0 && place[axis] < grid_.size_voxels[axis] - 1)) return std::nullopt;
    const glm::ivec3 low(glm::floor(place));
    const glm::dvec3 part = place - glm::dvec3(low);
    const glm::ivec3 nearest(glm::floor(place + 0.5));
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const std::uint16_t square = square_at(low + side);
        if (square == far) return std::nullopt;
        if (square == 0 && low + side == nearest) return 0.0F;
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) weight *= side[axis] == 1 ? part[axis] : 1.0 - part[axis];
        sum += weight * (square == 0 ? -0.5 : 0.5 * std::sqrt(static_cast<double>(square)));
    }
    const double distance_mm = std::max(sum, 0.0) * grid_.spacing_mm;
    if (distance_mm > reach_mm_) return std::nullopt;
    return static_cast<float>(distance_mm);
}

std::size_t DistanceField::memory_bytes() const {
    return slot_of_brick_.memory_bytes() + bricks_.capacity() * sizeof(BrickIndex) +
           squares_.capacity() * sizeof(SquareBrick);
}

}  // namespace osteomill
