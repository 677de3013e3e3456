#include "haptic_server/milling/carve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptic_server/milling/crescent_rows.h"

namespace osteomill {

namespace {

/// Voxels of one row of one brick that may change: where their fractions are and which candidates are theirs.
struct Chunk {
    std::uint8_t* row;  // its 16 fractions
    std::int32_t slot;
    std::uint16_t row_offset;  // of the row in its brick
    std::uint16_t first_candidate;
    std::uint16_t end_candidate;
};

/// Candidates of a short sweep, gathered row by row, then judged and lowered a batch at a time.
class Batch {
  public:
    Batch(Bone& bone, const glm::ivec3& base, const Sweep& ball, const CarveSettings& settings,
          EditSink& edits, RemovalSink& sink) noexcept
        : bone_(bone),
          sweep_(ball, glm::dvec3(base), settings.edges),
          instructions_(settings.instructions),
          edits_(edits),
          sink_(sink) {
        removed_.base = base;
    }

    /// Voxels first <= x < end of row (y, z), counted from the base, all in the brick at `slot`.
    void add(int first, int end, int y, int z, std::int32_t slot) noexcept {
        if (count_ + 16 > capacity || chunk_count_ == chunks_.size()) flush();
        const glm::ivec3 voxel = removed_.base + glm::ivec3(first, y, z);
        const std::size_t row_offset = offset_in_brick({0, voxel.y, voxel.z});
        std::uint8_t* const row = bone_.fractions(slot).data() + row_offset;
        Chunk chunk{.row = row,
                    .slot = slot,
                    .row_offset = static_cast<std::uint16_t>(row_offset),
                    .first_candidate = static_cast<std::uint16_t>(count_),
                    .end_candidate = 0};

        for (int x = first; x < end; ++x) {
            const int i = (removed_.base.x + x) & 15;
            if (row[i] == 0) continue;
            x_[count_] = static_cast<float>(x);
            y_[count_] = static_cast<float>(y);
            z_[count_] = static_cast<float>(z);
            place_[count_] = static_cast<std::uint8_t>(i);
            ++count_;
        }
        if (count_ == chunk.first_candidate) return;
        chunk.end_candidate = static_cast<std::uint16_t>(count_);
        chunks_[chunk_count_++] = chunk;
    }

    void flush() noexcept {
        if (count_ == 0) return;
        const std::size_t padded = (count_ + cover_lanes - 1) / cover_lanes * cover_lanes;
        for (std::size_t i = count_; i < padded; ++i) x_[i] = y_[i] = z_[i] = 0.0f;
        fractions_left(sweep_, {x_.data(), padded}, {y_.data(), padded}, {z_.data(), padded},
                       {left_.data(), padded}, instructions_);
        removed_.count = 0;
        for (std::size_t i = 0; i < chunk_count_; ++i) lower(chunks_[i]);
        if (removed_.count > 0) {
            removed_.pad();
            sink_.take(removed_);
        }
        count_ = 0;
        chunk_count_ = 0;
    }

  private:
    static constexpr std::size_t capacity = RemovedVoxels::capacity;

    void lower(const Chunk& chunk) noexcept {
        int changed_first = 16;
        int changed_last = -1;
        for (std::size_t candidate = chunk.first_candidate; candidate < chunk.end_candidate; ++candidate) {
            const int i = place_[candidate];
            const int old = chunk.row[i];
            const int left = left_[candidate];
            if (left >= old) continue;
            chunk.row[i] = static_cast<std::uint8_t>(left);
            changed_first = std::min(changed_first, i);
            changed_last = i;
            const std::size_t n = removed_.count++;
            removed_.x[n] = x_[candidate];
            removed_.y[n] = y_[candidate];
            removed_.z[n] = z_[candidate];
            removed_.codes[n] = static_cast<float>(old - left);
            removed_.slot[n] = chunk.slot;
            removed_.offset[n] = static_cast<std::uint16_t>(chunk.row_offset + i);
        }
        if (changed_last < 0) return;
        EditRun run{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(chunk.slot)],
                    .first_voxel = static_cast<std::uint16_t>(chunk.row_offset + changed_first),
                    .count = static_cast<std::uint8_t>(changed_last - changed_first + 1)};
        std::copy_n(chunk.row + changed_first, run.count, run.fraction.begin());
        edits_.push(run);
    }

    Bone& bone_;
    SweepSeenFrom sweep_;
    InstructionSet instructions_;
    EditSink& edits_;
    RemovalSink& sink_;
    std::size_t count_ = 0;
    std::size_t chunk_count_ = 0;
    // Scratch, not cleared: a step starts with nothing to do.
    alignas(64) std::array<float, capacity> x_;
    alignas(64) std::array<float, capacity> y_;
    alignas(64) std::array<float, capacity> z_;
    alignas(64) std::array<std::int32_t, capacity> left_;
    std::array<std::uint8_t, capacity> place_;  // in the row of its brick
    std::array<Chunk, capacity> chunks_;
    RemovedVoxels removed_;
};

/// Slots of the bricks that one layer of a short sweep can change, looked up once for all of their rows.
class BrickLayer {
  public:
    BrickLayer(const Bone& bone, const glm::ivec3& base, const CrescentRows& rows, VoxelRange x, VoxelRange y,
               int brick_z) noexcept
        : first_x_((base.x + x.first) >> 4), first_y_((base.y + y.first) >> 4) {
        const int end_x = ((base.x + x.end - 1) >> 4) + 1;
        const int end_y = ((base.y + y.end - 1) >> 4) + 1;
        for (int by = first_y_; by < end_y; ++by) {
            bool any = false;
            for (int bx = first_x_; bx < end_x; ++bx) {
                const glm::ivec3 brick(bx, by, brick_z);
                std::int32_t slot = bone.slot(brick);
                if (slot != BoneContent::no_slot &&
                    rows.misses_cube(brick * brick_edge_voxels - base, brick_edge_voxels))
                    slot = BoneContent::no_slot;
                slots_[place(bx, by)] = slot;
                any |= slot != BoneContent::no_slot;
            }
            holds_bone_[static_cast<std::size_t>(by - first_y_)] = any;
            holds_any_ |= any;
        }
    }

    bool holds_any() const { return holds_any_; }
    bool row_holds_any(int brick_y) const {
        return holds_bone_[static_cast<std::size_t>(brick_y - first_y_)];
    }
    std::int32_t slot(int brick_x, int brick_y) const { return slots_[place(brick_x, brick_y)]; }

  private:
    static constexpr int most = CrescentRows::most_rows / brick_edge_voxels + 2;

    std::size_t place(int brick_x, int brick_y) const {
        return static_cast<std::size_t>((brick_y - first_y_) * most + (brick_x - first_x_));
    }

    int first_x_;
    int first_y_;
    bool holds_any_ = false;
    std::array<bool, most> holds_bone_;
    std::array<std::int32_t, most * most> slots_;
};

/// A range counted from `base`, cut to the grid's voxels 0 to size - 1.
VoxelRange within_grid(const VoxelRange& range, int base, int size) {
    return {std::max(range.first, -base), std::min(range.end, size - base)};
}

/// A sweep of at most CrescentRows::longest_step_voxels.
void carve_short(Bone& bone, const Sweep& ball, bool crescent_only, const CarveSettings& settings,
                 EditSink& edits, RemovalSink& sink) noexcept {
    const glm::ivec3 size = bone.grid().size_voxels;
    const auto reach = static_cast<int>(std::ceil(ball.radius)) + 3;
    const glm::ivec3 base = glm::ivec3(glm::floor(0.5 * (ball.from + ball.to))) - reach;
    const glm::dvec3 origin(base);
    CrescentRows rows({ball.from - origin, ball.to - origin, ball.radius}, crescent_only);
    const VoxelRange all_x = within_grid({0, 2 * reach + 1}, base.x, size.x);
    const VoxelRange all_y = within_grid(rows.rows(), base.y, size.y);
    const VoxelRange all_z = within_grid(rows.slices(), base.z, size.z);
    if (all_x.empty() || all_y.empty() || all_z.empty()) return;

    Batch batch(bone, base, ball, settings, edits, sink);
    for (int layer_first = all_z.first; layer_first < all_z.end;) {
        const int brick_z = (base.z + layer_first) >> 4;
        const int layer_end = std::min(all_z.end, 16 * (brick_z + 1) - base.z);
        const BrickLayer layer(bone, base, rows, all_x, all_y, brick_z);
        for (int z = layer_first; layer.holds_any() && z < layer_end; ++z) {
            rows.begin_slice(z);
            for (int y = all_y.first; y < all_y.end; ++y) {
                const int brick_y = (base.y + y) >> 4;
                if (!layer.row_holds_any(brick_y)) {
                    y = std::min(all_y.end, 16 * (brick_y + 1) - base.y) - 1;
                    continue;
                }
                for (const VoxelRange& part : rows.ranges(y)) {
                    const VoxelRange range = within_grid(part, base.x, size.x);
                    for (int x = range.first; x < range.end;) {
                        const int brick_x = (base.x + x) >> 4;
                        const int end = std::min(range.end, 16 * (brick_x + 1) - base.x);
                        const std::int32_t slot = layer.slot(brick_x, brick_y);
                        if (slot != BoneContent::no_slot) batch.add(x, end, y, z, slot);
                        x = end;
                    }
                }
            }
        }
        layer_first = layer_end;
    }
    batch.flush();
}

/// The part of a sweep near which the grid has voxels, or nothing.
bool cut_to_grid(Sweep& sweep, const glm::ivec3& size) {
    const glm::dvec3 along = sweep.to - sweep.from;
    const double margin = sweep.radius + 1.0;
    double first = 0.0;
    double last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = -margin - sweep.from[axis];
        const double high = size[axis] - 1 + margin - sweep.from[axis];
        if (along[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double a = low / along[axis];
        const double b = high / along[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    if (!(first <= last)) return false;
    const glm::dvec3 from = sweep.from;
    if (first > 0.0) sweep.from = from + first * along;
    if (last < 1.0) sweep.to = from + last * along;
    return true;
}

}  // namespace

void carve(Bone& bone, const Sweep& ball, CarveHistory history, const CarveSettings& settings,
           EditSink& edits, RemovalSink& removed) noexcept {
    Sweep sweep = ball;
    if (!cut_to_grid(sweep, bone.grid().size_voxels)) return;
    if (history == CarveHistory::none)
        carve_short(bone, {sweep.from, sweep.from, sweep.radius}, false, settings, edits, removed);
    const glm::dvec3 along = sweep.to - sweep.from;
    const double length = glm::length(along);
    if (length == 0.0) return;
    // A long sweep is a chain of short ones: each looks only at its own crescent.
    const double parts = std::ceil(length / CrescentRows::longest_step_voxels);
    glm::dvec3 from = sweep.from;
    for (double part = 1.0; part <= parts; part += 1.0) {
        const glm::dvec3 to = part == parts ? sweep.to : sweep.from + along * (part / parts);
        carve_short(bone, {from, to, sweep.radius}, true, settings, edits, removed);
        from = to;
    }
}

}  // namespace osteomill
