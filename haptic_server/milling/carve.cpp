#include "haptic_server/milling/carve.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptic_server/milling/crescent_rows.h"

namespace osteomill {

namespace {

/// The 16 fractions of a row of a brick as two words, to see which of them differ.
struct RowBytes {
    RowBytes() = default;
    explicit RowBytes(const std::uint8_t* row) { std::memcpy(words.data(), row, sizeof words); }

    std::array<std::uint64_t, 2> words;
};

/// First and last of 16 voxels that differ; `last` < 0 where none does. Byte 0 is the lowest of a word.
struct Difference {
    static_assert(std::endian::native == std::endian::little);

    Difference(const RowBytes& a, const RowBytes& b) {
        const std::uint64_t low = a.words[0] ^ b.words[0];
        const std::uint64_t high = a.words[1] ^ b.words[1];
        if ((low | high) == 0) return;
        first = low != 0 ? std::countr_zero(low) / 8 : 8 + std::countr_zero(high) / 8;
        last = high != 0 ? 15 - std::countl_zero(high) / 8 : 7 - std::countl_zero(low) / 8;
    }

    int first = 0;
    int last = -1;
};

/// Voxels of one row of one brick that may change.
struct Chunk {
    std::uint8_t* row;
    RowBytes before;
    std::int32_t slot;
    std::uint16_t row_offset;  // of the row in its brick
};

/// Candidates of a short sweep, gathered row by row, then judged and lowered a batch at a time. Rows of the
/// crescent are a few voxels long, so nobody can predict where their loops end: what is done for each voxel
/// runs over the whole batch instead, without a branch.
class Batch {
  public:
    Batch(Bone& bone, const glm::ivec3& base, const Sweep& ball, const CarveSettings& settings,
          EditSink& edits, RemovalSink& sink) noexcept
        : bone_(bone),
          sweep_(ball, glm::dvec3(base), settings.edges),
          instructions_(settings.instructions),
          edits_(edits),
          sink_(sink) {
        voxels_.base = base;
    }

    /// Voxels first <= x < end of row (y, z), counted from the base, all in the brick at `slot`.
    void add(int first, int end, int y, int z, std::int32_t slot) noexcept {
        if (voxels_.count + brick_edge_voxels + group > capacity || chunk_count_ == most_chunks) flush();
        const glm::ivec3 voxel = voxels_.base + glm::ivec3(first, y, z);
        const std::size_t row_offset = offset_in_brick({0, voxel.y, voxel.z});
        std::uint8_t* const row = bone_.fractions(slot).data() + row_offset;
        const int place = voxel.x & 15;
        const int length = end - first;
        if (length <= group && holds_nothing(row + std::min(place, brick_edge_voxels - group))) return;
        chunks_[chunk_count_++] = {.row = row,
                                   .before = RowBytes(row),
                                   .slot = slot,
                                   .row_offset = static_cast<std::uint16_t>(row_offset)};
        // Whole groups; those beyond `length` are overwritten by the next row or left behind.
        for (int done = 0; done < length; done += group)
            for (int i = done; i < done + group; ++i) {
                const std::size_t candidate = voxels_.count + static_cast<std::size_t>(i);
                voxels_.x[candidate] = static_cast<float>(first + i);
                voxels_.y[candidate] = static_cast<float>(y);
                voxels_.z[candidate] = static_cast<float>(z);
                voxels_.slot[candidate] = slot;
                const int at = std::min(place + i, brick_edge_voxels - 1);
                voxels_.offset[candidate] = static_cast<std::uint16_t>(static_cast<int>(row_offset) + at);
                fraction_[candidate] = row + at;
            }
        voxels_.count += static_cast<std::size_t>(length);
    }

    void flush() noexcept {
        voxels_.pad();
        const std::size_t padded = voxels_.padded_count();
        fractions_left(sweep_, {voxels_.x.data(), padded}, {voxels_.y.data(), padded},
                       {voxels_.z.data(), padded}, {left_.data(), padded}, instructions_);
        for (std::size_t i = 0; i < voxels_.count; ++i) {
            const int old = *fraction_[i];
            const int left = std::min(left_[i], old);
            *fraction_[i] = static_cast<std::uint8_t>(left);
            voxels_.codes[i] = static_cast<float>(old - left);
        }
        for (std::size_t i = 0; i < chunk_count_; ++i) report(chunks_[i]);
        if (voxels_.count > 0) sink_.take(voxels_);
        voxels_.count = 0;
        chunk_count_ = 0;
    }

  private:
    /// Whether a group of fractions is all zero: most of what a burr in its own groove meets.
    static bool holds_nothing(const std::uint8_t* fractions) {
        static_assert(group == sizeof(std::uint32_t));
        std::uint32_t bytes;
        std::memcpy(&bytes, fractions, sizeof bytes);
        return bytes == 0;
    }

    static constexpr std::size_t capacity = RemovedVoxels::capacity;
    static constexpr std::size_t most_chunks = capacity;
    static constexpr int group = 4;

    void report(const Chunk& chunk) noexcept {
        const Difference changed(chunk.before, RowBytes(chunk.row));
        if (changed.last < 0) return;
        const auto first_voxel = static_cast<std::size_t>(chunk.row_offset + changed.first);
        EditRun run{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(chunk.slot)],
                    .first_voxel = static_cast<std::uint16_t>(first_voxel),
                    .count = static_cast<std::uint8_t>(changed.last - changed.first + 1)};
        // A copy of fixed length is the quickest; it must not leave the brick.
        if (first_voxel + run.fraction.size() <= brick_voxel_count)
            std::copy_n(chunk.row + changed.first, run.fraction.size(), run.fraction.begin());
        else
            std::copy_n(chunk.row + changed.first, run.count, run.fraction.begin());
        edits_.push(run);
    }

    Bone& bone_;
    SweepSeenFrom sweep_;
    InstructionSet instructions_;
    EditSink& edits_;
    RemovalSink& sink_;
    std::size_t chunk_count_ = 0;
    // Scratch, not cleared: a step starts with nothing to do.
    RemovedVoxels voxels_;
    std::array<std::uint8_t*, capacity> fraction_;  // of each voxel, in the bone
    alignas(64) std::array<std::int32_t, capacity> left_;
    std::array<Chunk, most_chunks> chunks_;
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

/// A sweep of at most CrescentRows::longest_step_voxels.
void carve_short(Bone& bone, const Sweep& ball, bool crescent_only, const CarveSettings& settings,
                 EditSink& edits, RemovalSink& sink) noexcept {
    const glm::ivec3 size = bone.grid().size_voxels;
    const auto reach = static_cast<int>(std::ceil(ball.radius)) + 3;
    const glm::ivec3 base = glm::ivec3(glm::floor(0.5 * (ball.from + ball.to))) - reach;
    const glm::dvec3 origin(base);
    CrescentRows rows({ball.from - origin, ball.to - origin, ball.radius}, crescent_only,
                      glm::max(-base, glm::ivec3(0)), size - base);
    const VoxelRange all_x = rows.columns();
    const VoxelRange all_y = rows.rows();
    const VoxelRange all_z = rows.slices();
    if (all_x.empty() || all_y.empty() || all_z.empty()) return;

    Batch batch(bone, base, ball, settings, edits, sink);
    for (int layer_first = all_z.first; layer_first < all_z.end;) {
        const int brick_z = (base.z + layer_first) >> 4;
        const int layer_end = std::min(all_z.end, 16 * (brick_z + 1) - base.z);
        const BrickLayer layer(bone, base, rows, all_x, all_y, brick_z);
        for (int z = layer_first; layer.holds_any() && z < layer_end; ++z) {
            const VoxelRange slice_rows = rows.begin_slice(z, settings.instructions);
            for (int y = slice_rows.first; y < slice_rows.end; ++y) {
                const int brick_y = (base.y + y) >> 4;
                if (!layer.row_holds_any(brick_y)) {
                    y = std::min(slice_rows.end, 16 * (brick_y + 1) - base.y) - 1;
                    continue;
                }
                const auto add_part = [&](const VoxelRange& part) {
                    for (int x = part.first; x < part.end;) {
                        const int brick_x = (base.x + x) >> 4;
                        const int end = std::min(part.end, 16 * (brick_x + 1) - base.x);
                        const std::int32_t slot = layer.slot(brick_x, brick_y);
                        if (slot != BoneContent::no_slot) batch.add(x, end, y, z, slot);
                        x = end;
                    }
                };
                add_part(rows.left(y));
                add_part(rows.right(y));
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
