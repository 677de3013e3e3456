#include "haptic_server/carving/carve_kernel.h"

#include <algorithm>
#include <bit>

#include "haptic_server/carving/crescent_rows_simd.h"
#include "haptic_server/carving/voxel_coverage_simd.h"

namespace osteomill {

using simd::Floats;
using simd::Ints;

static_assert(simd::width == RemovedVoxels::lanes);

CarveKernel::CarveKernel(Bone& bone, const glm::ivec3& base, const SweepSeenFrom& sweep,
                         InstructionSet instructions, EditSink& edits, RemovalSink& removed) noexcept
    : bone_(bone), sweep_(sweep), instructions_(instructions), edits_(edits), sink_(removed) {
    voxels_.base = base;
}

struct CarveKernel::Loops {
    CarveKernel& to;

    static constexpr int eight = 8;
    /// Groups of eight rows in a row of bricks: two a slice.
    static constexpr int most_groups = 2 * brick_edge_voxels;

    /// The bricks, along x, in which a part of eight rows lies.
    struct Bricks {
        int first = 0;
        int last = -1;
    };

    struct Group {
        Ints first;
        Ints end;
        Bricks bricks;
    };

    /// Whether rows y to y + 7 of a slice pass the ball by.
    static bool misses(const CrescentRows::Shape& shape, int y, int z) {
        const float low = static_cast<float>(y) - shape.middle.y;
        const float across = std::max({low, -low - static_cast<float>(eight - 1), 0.0f});
        const float dz = static_cast<float>(z) - shape.middle.z;
        return across * across + dz * dz >
               shape.outer_squared + static_cast<float>(CrescentRows::slack_voxels);
    }

    [[gnu::always_inline]] static Group group_of(const Ints& first, const Ints& end) {
        Group group{first, end, {}};
        const Ints is_empty = first >= end;
        if (!simd::any(~is_empty)) return group;
        const int last = simd::largest(end & ~is_empty) - 1;
        group.bricks = {simd::smallest(is_empty ? simd::ints(last) : first) / brick_edge_voxels,
                        last / brick_edge_voxels};
        return group;
    }

    /// Appends a group's voxels in the brick at `brick_x` to the list.
    [[gnu::always_inline]] void list_group(const Group& group, int brick_x, int offset, std::size_t& count) {
        if (brick_x < group.bricks.first || brick_x > group.bricks.last) return;
        const Ints in_brick_first = group.first - brick_x * brick_edge_voxels;
        const Ints in_brick_end = group.end - brick_x * brick_edge_voxels;
        const Ints end = simd::smaller(in_brick_end, simd::ints(brick_edge_voxels));
        const Ints x = simd::larger(in_brick_first, Ints{});
        std::array<std::int32_t, simd::width> first;
        std::array<std::int32_t, simd::width> length;
        simd::store(first.data(), x + (offset + brick_edge_voxels * simd::counting()));
        simd::store(length.data(), simd::larger(end - x, Ints{}));
        const bool any_longer_than_eight = simd::largest(end - x) > eight;
        // Eight voxels are written for each row, of which the next row overwrites what is too many.
        for (unsigned rows = simd::bits_of(end > x); rows != 0; rows &= rows - 1) {
            const auto row = static_cast<std::size_t>(std::countr_zero(rows));
            const Ints voxels = first[row] + simd::counting();
            simd::store(&to.list_[count], voxels);
            if (any_longer_than_eight) simd::store(&to.list_[count + simd::width], voxels + eight);
            to.rows_[to.row_count_] = {static_cast<std::uint16_t>(first[row]),
                                       static_cast<std::uint16_t>(length[row]),
                                       static_cast<std::uint16_t>(count)};
            ++to.row_count_;
            count += static_cast<std::size_t>(length[row]);
        }
    }

    /// By registers: what is written byte by byte cannot be read as a vector until it has reached the cache.
    [[gnu::always_inline]] static Ints gathered(const std::uint8_t* bytes, const std::int32_t* at) {
        return Ints{bytes[at[0]], bytes[at[1]], bytes[at[2]], bytes[at[3]],
                    bytes[at[4]], bytes[at[5]], bytes[at[6]], bytes[at[7]]};
    }

    /// Eight voxels of the list.
    struct EightVoxels {
        Ints offset;
        Ints old;  // fractions; 0 for those that are not asked for
        Floats x;
        Floats y;
        Floats z;
    };

    /// Those from entry `i` of the list on, up to `count`. `corner`: the brick's first voxel.
    [[gnu::always_inline]] EightVoxels eight_voxels(const std::uint8_t* fractions, const glm::ivec3& corner,
                                                    std::size_t i, std::size_t count) const {
        const Ints offset = simd::load<Ints>(&to.list_[i]);
        const Ints is_asked = simd::counting() < static_cast<int>(count) - static_cast<int>(i);
        return {offset, gathered(fractions, &to.list_[i]) & is_asked,
                simd::to_floats(corner.x + (offset & 15)), simd::to_floats(corner.y + (offset >> 4 & 15)),
                simd::to_floats(corner.z + (offset >> 8))};
    }

    /// Asks double precision where single precision is not sure.
    template <VoxelCoverage coverage>
    static void make_sure(const SweepSeenFrom& sweep, const EightVoxels& voxels, EightLevelsLeft& left) {
        for (unsigned unsure = simd::bits_of(left.is_unsure); unsure != 0; unsure &= unsure - 1) {
            const int i = std::countr_zero(unsure);
            left.left[i] = osteomill::level_left<coverage>(sweep, voxels.x[i], voxels.y[i], voxels.z[i]);
        }
    }

    /// Adds eight voxels and what they lose to a batch that has room for them.
    [[gnu::always_inline]] static void append(RemovedVoxels& out, const EightVoxels& voxels,
                                              const Floats& levels, std::int32_t slot) {
        const std::size_t n = out.count;
        simd::store(&out.x[n], voxels.x);
        simd::store(&out.y[n], voxels.y);
        simd::store(&out.z[n], voxels.z);
        simd::store(&out.levels[n], levels);
        simd::store(&out.slot[n], simd::ints(slot));
        simd::store(&out.offset[n], voxels.offset);
        out.count += simd::width;
    }

    /// Writes what is left of eight voxels and lists those that lost something. Says which did.
    [[gnu::always_inline]] std::uint8_t carve_eight(const EightVoxels& voxels, const Ints& most_left,
                                                    std::uint8_t* fractions, std::int32_t slot, std::size_t i,
                                                    std::size_t count) {
        const Ints left = simd::smaller(voxels.old, most_left);
        const Ints lost = voxels.old - left;
        const auto changed = static_cast<std::uint8_t>(simd::bits_of(lost > 0));
        if (changed == 0) return 0;
        std::array<std::int32_t, simd::width> lefts;
        simd::store(lefts.data(), left);
        const auto write = [&](std::size_t lane) {
            fractions[static_cast<std::size_t>(to.list_[i + lane])] = static_cast<std::uint8_t>(lefts[lane]);
        };
        if (i + simd::width <= count)  // of a known length the loop is none
            for (std::size_t lane = 0; lane < simd::width; ++lane) write(lane);
        else
            for (std::size_t lane = 0; i + lane < count; ++lane) write(lane);
        if (to.voxels_.count == RemovedVoxels::capacity) to.hand_on_voxels();
        append(to.voxels_, voxels, simd::to_floats(lost), slot);
        return changed;
    }

    /// Lowers the voxels of the list. Two times eight in turn: the roots of one are waited for while the
    /// other's are computed.
    template <VoxelCoverage coverage>
    [[gnu::always_inline]] void carve_list(const SweepSeenFrom& sweep, const SimdSweep& fast,
                                           std::int32_t slot, const glm::ivec3& corner, std::size_t count) {
        std::uint8_t* const fractions = to.bone_.fractions(slot).data();
        // The last sixteen are filled up with a voxel that is not asked for.
        simd::store(&to.list_[count], simd::ints(to.list_[0]));
        simd::store(&to.list_[count + simd::width], simd::ints(to.list_[0]));
        for (std::size_t i = 0; i < count; i += 2 * simd::width) {
            std::uint8_t* const changed = &to.changed_[i / simd::width];
            changed[0] = changed[1] = 0;
            const EightVoxels a = eight_voxels(fractions, corner, i, count);
            const EightVoxels b = eight_voxels(fractions, corner, i + simd::width, count);
            if (!simd::any(a.old | b.old)) continue;  // the burr in its own groove
            EightLevelsLeft left_a = level_left<coverage>(fast, a.x, a.y, a.z);
            EightLevelsLeft left_b = level_left<coverage>(fast, b.x, b.y, b.z);
            if (simd::any(left_a.is_unsure | left_b.is_unsure)) [[unlikely]] {
                make_sure<coverage>(sweep, a, left_a);
                make_sure<coverage>(sweep, b, left_b);
            }
            changed[0] = carve_eight(a, left_a.left, fractions, slot, i, count);
            if (i + simd::width < count)
                changed[1] = carve_eight(b, left_b.left, fractions, slot, i + simd::width, count);
        }
    }

    template <VoxelCoverage coverage>
    [[gnu::always_inline]] void carve_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                                             const VoxelRange& slices) {
        const SweepSeenFrom sweep = to.sweep_;
        const SimdSweep fast(sweep);
        const CrescentRows::Shape shape = rows.shape();
        const int first_y = brick_y * brick_edge_voxels;
        const int first_z = slices.first / brick_edge_voxels * brick_edge_voxels;
        const int first_group = 2 * (slices.first - first_z);
        const int end_group = 2 * (slices.end - first_z);
        std::array<Group, most_groups> left;
        std::array<Group, most_groups> right;
        Bricks all{layer.end_x(), -1};
        for (int g = first_group; g < end_group; ++g) {
            const auto at = static_cast<std::size_t>(g);
            if (misses(shape, first_y + eight * (g % 2), first_z + g / 2)) {
                left[at].bricks = right[at].bricks = {};
                continue;
            }
            const EightRows eight_of = eight_rows(shape, first_y + eight * (g % 2), first_z + g / 2);
            left[at] = group_of(eight_of.left_first, eight_of.left_end);
            right[at] = group_of(eight_of.right_first, eight_of.right_end);
            for (const Bricks& bricks : {left[at].bricks, right[at].bricks}) {
                if (bricks.last < 0) continue;
                all.first = std::min(all.first, bricks.first);
                all.last = std::max(all.last, bricks.last);
            }
        }
        for (int brick_x = all.first; brick_x <= all.last; ++brick_x) {
            const std::int32_t slot = layer.slot(brick_x, brick_y);
            if (slot == BoneContent::no_slot) continue;
            std::size_t count = 0;
            to.row_count_ = 0;
            for (int g = first_group; g < end_group; ++g) {
                const auto at = static_cast<std::size_t>(g);
                list_group(left[at], brick_x, g * eight * brick_edge_voxels, count);
                list_group(right[at], brick_x, g * eight * brick_edge_voxels, count);
            }
            if (count == 0) continue;
            // By now what was written to the brick before has reached the cache.
            to.report_changes();
            carve_list<coverage>(sweep, fast, slot, {brick_x * brick_edge_voxels, first_y, first_z}, count);
            to.changed_slot_ = slot;
            std::copy_n(to.rows_.begin(), to.row_count_, to.changed_rows_.begin());
            to.changed_row_count_ = to.row_count_;
        }
    }

    [[gnu::always_inline]] void carve_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                                             const VoxelRange& slices) {
        if (to.sweep_.coverage == VoxelCoverage::linear)
            carve_bricks<VoxelCoverage::linear>(rows, layer, brick_y, slices);
        else if (to.sweep_.coverage == VoxelCoverage::smoothed)
            carve_bricks<VoxelCoverage::smoothed>(rows, layer, brick_y, slices);
        else
            carve_bricks<VoxelCoverage::binary>(rows, layer, brick_y, slices);
    }
};

void CarveKernel::carve_bricks_plain(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                                     const VoxelRange& z) noexcept {
    Loops{*this}.carve_bricks(rows, layer, brick_y, z);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void CarveKernel::carve_bricks_avx2(const CrescentRows& rows, const BrickLayer& layer,
                                                            int brick_y, const VoxelRange& z) noexcept {
    Loops{*this}.carve_bricks(rows, layer, brick_y, z);
}
#endif

void CarveKernel::carve_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                               const VoxelRange& z) noexcept {
#if defined(__x86_64__)
    if (instructions_ == InstructionSet::avx2) {
        carve_bricks_avx2(rows, layer, brick_y, z);
        return;
    }
#endif
    carve_bricks_plain(rows, layer, brick_y, z);
}

void CarveKernel::report_changes() noexcept {
    if (changed_slot_ == BoneContent::no_slot) return;
    for (std::size_t i = 0; i < changed_row_count_; ++i) {
        const Row& row = changed_rows_[i];
        const std::uint8_t* const stream = &changed_[row.list_start / 8];
        const unsigned from_start = (stream[0] | stream[1] << 8u | stream[2] << 16u) >> row.list_start % 8;
        const unsigned voxels = from_start & ((1u << row.length) - 1u);
        if (voxels == 0) continue;
        report_run(row.first + static_cast<std::size_t>(std::countr_zero(voxels)),
                   row.first + static_cast<std::size_t>(31 - std::countl_zero(voxels)));
    }
    changed_slot_ = BoneContent::no_slot;
}

void CarveKernel::report_run(std::size_t first_voxel, std::size_t last_voxel) noexcept {
    const std::uint8_t* const fractions = bone_.fractions(changed_slot_).data() + first_voxel;
    EditRun run{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(changed_slot_)],
                .first_voxel = static_cast<std::uint16_t>(first_voxel),
                .count = static_cast<std::uint8_t>(last_voxel - first_voxel + 1)};
    // A copy of fixed length is the quickest; it must not leave the brick.
    if (first_voxel + run.fraction.size() <= brick_voxel_count)
        std::copy_n(fractions, run.fraction.size(), run.fraction.begin());
    else
        std::copy_n(fractions, run.count, run.fraction.begin());
    edits_.push(run);
}

void CarveKernel::hand_on_voxels() noexcept {
    if (voxels_.count > 0) sink_.take(voxels_);
    voxels_.count = 0;
}

void CarveKernel::flush() noexcept {
    report_changes();
    hand_on_voxels();
}

}  // namespace osteomill
