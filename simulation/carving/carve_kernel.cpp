#include "simulation/carving/carve_kernel.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "simulation/carving/carve_simd.h"

namespace osteomill {

using simd::Bytes;
using simd::Floats;
using simd::Floats3;
using simd::Ints;

static_assert(simd::width == RemovedVoxels::lanes);

CarveKernel::CarveKernel(Bone& bone, const glm::ivec3& base, const SweepSeenFrom& sweep,
                         const CarveSettings& settings, ChangeSink* changes, RemovalSink& removed) noexcept
    : bone_(bone),
      sweep_(sweep),
      instructions_(settings.instructions),
      uncut_(settings.uncut),
      changes_(changes),
      sink_(removed) {
    voxels_.base = base;
}

struct CarveKernel::Loops {
    CarveKernel& to;

    static constexpr int eight = 8;

    /// Left or right parts of eight rows of a slice.
    struct Parts {
        Ints first;
        Ints end;
        int first_row;  ///< offset in a brick of the first row's first voxel
    };
    /// The parts of a row of bricks: twice eight rows a slice, left and right.
    using ManyParts = std::array<Parts, std::size_t{4} * brick_edge_voxels>;

    /// Finds the parts of the rows in row `brick_y` of a layer that are not empty. Returns how many.
    [[gnu::always_inline]] static std::size_t find_parts(const CrescentRows& rows, int brick_y,
                                                         const VoxelRange& slices, ManyParts& parts) {
        const CrescentRows::Shape shape = rows.shape();
        std::size_t count = 0;
        for (int z = slices.first; z < slices.end; ++z)
            for (int y = 0; y < brick_edge_voxels; y += eight) {
                const EightRows found = eight_rows(shape, brick_y * brick_edge_voxels + y, z);
                const int first_row = (z % brick_edge_voxels * brick_edge_voxels + y) * brick_edge_voxels;
                parts[count] = {found.left_first, found.left_end, first_row};
                count += simd::any(found.left_first < found.left_end) ? 1u : 0u;
                parts[count] = {found.right_first, found.right_end, first_row};
                count += simd::any(found.right_first < found.right_end) ? 1u : 0u;
            }
        return count;
    }

    /// Lists the rows of the parts that lie in the brick at `brick_x`.
    [[gnu::always_inline]] void list_rows(const ManyParts& parts, std::size_t part_count, int brick_x) {
        std::size_t count = 0;
        for (std::size_t part = 0; part < part_count; ++part) {
            const Ints first = simd::larger(parts[part].first - brick_x * brick_edge_voxels, Ints{});
            const Ints end =
                simd::smaller(parts[part].end - brick_x * brick_edge_voxels, simd::ints(brick_edge_voxels));
            const Ints first_voxel = first + brick_edge_voxels * simd::counting() + parts[part].first_row;
            count += simd::store_chosen(end > first, Row::packed(first_voxel, end - first), &to.rows_[count]);
        }
        to.row_count_ = count;
    }

    /// Lists their voxels. Returns how many.
    [[gnu::always_inline]] std::size_t list_voxels(const std::uint8_t* fractions) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < to.row_count_; ++i) {
            // Sixteen voxels are written for each row; the next row overwrites the surplus.
            const Row row = to.rows_[i];
            const Ints voxels = static_cast<std::int32_t>(row.first()) + simd::counting();
            simd::store(&to.list_[count], voxels);
            simd::store(&to.list_[count + simd::width], voxels + eight);
            copy_row(fractions + row.first(), row, to.left_of_list() + count);
            count += row.length();
        }
        return count;
    }

    /// A copy of fixed length is the quickest; it must not leave the brick.
    [[gnu::always_inline]] static void copy_row(const std::uint8_t* fractions, const Row& row,
                                                std::uint8_t* copy) {
        if (row.first() <= brick_voxel_count - brick_edge_voxels)
            std::copy_n(fractions, brick_edge_voxels, copy);
        else
            std::copy_n(fractions, row.length(), copy);
    }

    /// Eight voxels of the list.
    struct EightVoxels {
        Ints offset;
        Ints old;  // fractions
        Floats3 position;
    };

    /// Those from entry `i` of the list on. `corner`: the brick's first voxel.
    [[gnu::always_inline]] EightVoxels eight_voxels(const glm::ivec3& corner, std::size_t i) const {
        const Ints offset = simd::load<Ints>(&to.list_[i]);
        return {offset,
                simd::load_bytes(to.left_of_list() + i),
                {simd::to_floats(corner.x + (offset & 15)), simd::to_floats(corner.y + (offset >> 4 & 15)),
                 simd::to_floats(corner.z + (offset >> 8))}};
    }

    /// Asks double precision where single precision is not sure.
    template <VoxelCoverage coverage>
    static void make_sure(const SweepSeenFrom& sweep, const EightVoxels& voxels, EightLevelsLeft& left) {
        for (unsigned unsure = simd::bits_of(left.is_unsure); unsure != 0; unsure &= unsure - 1) {
            const int i = std::countr_zero(unsure);
            left.left[i] = osteomill::level_left<coverage>(sweep, voxels.position.x[i], voxels.position.y[i],
                                                           voxels.position.z[i]);
        }
    }

    /// Keeps all of the tissue that no burr cuts.
    void keep_uncut(const EightVoxels& voxels, std::int32_t slot, Ints& left) const {
        for (int i = 0; i < eight; ++i) {
            const auto offset = static_cast<std::size_t>(voxels.offset[i]);
            if (to.uncut_->of_label[to.bone_.content().tissue_in(slot, offset)]) left[i] = 255;
        }
    }

    /// Adds eight voxels and their losses to a batch that has space for them.
    [[gnu::always_inline]] static void append(RemovedVoxels& out, const EightVoxels& voxels,
                                              const Floats& levels, const Ints& slot) {
        const std::size_t n = out.count;
        simd::store(&out.x[n], voxels.position.x);
        simd::store(&out.y[n], voxels.position.y);
        simd::store(&out.z[n], voxels.position.z);
        simd::store(&out.levels[n], levels);
        simd::store(&out.slot[n], slot);
        simd::store(&out.offset[n], voxels.offset);
        out.count += simd::width;
    }

    /// Lowers eight voxels of the list, from entry `i` on, and adds them to the batch if one lost something.
    [[gnu::always_inline]] void carve_eight(const EightVoxels& voxels, const Ints& most_left,
                                            const Ints& slot, std::size_t i) {
        const Ints left = simd::smaller(voxels.old, most_left);
        const Ints lost = voxels.old - left;
        if (!simd::any(lost)) return;
        simd::store_bytes(to.left_of_list() + i, left);
        if (to.voxels_.count == RemovedVoxels::capacity) to.hand_on_voxels();
        append(to.voxels_, voxels, simd::to_floats(lost), slot);
    }

    /// Lowers the voxels of the list. Two times eight in turn: the roots of one are waited for while the
    /// other's are computed.
    template <VoxelCoverage coverage>
    [[gnu::always_inline]] void carve_list(const SweepSeenFrom& sweep, const SimdSweep& fast,
                                           std::int32_t slot, const glm::ivec3& corner, std::size_t count) {
        // The last sixteen are filled up with voxels of which nothing is left.
        simd::store(&to.list_[count], Ints{});
        simd::store(&to.list_[count + simd::width], Ints{});
        std::fill_n(to.left_of_list() + count, 2 * simd::width, std::uint8_t{0});
        const Ints slots = simd::ints(slot);
        for (std::size_t i = 0; i < count; i += 2 * simd::width) {
            const EightVoxels a = eight_voxels(corner, i);
            const EightVoxels b = eight_voxels(corner, i + simd::width);
            if (!simd::any(a.old | b.old)) continue;  // the burr in its own groove
            EightLevelsLeft left_a = level_left<coverage>(fast, a.position);
            EightLevelsLeft left_b = level_left<coverage>(fast, b.position);
            if (simd::any(left_a.is_unsure | left_b.is_unsure)) [[unlikely]] {
                make_sure<coverage>(sweep, a, left_a);
                make_sure<coverage>(sweep, b, left_b);
            }
            if (to.uncut_ != nullptr) [[unlikely]] {
                keep_uncut(a, slot, left_a.left);
                keep_uncut(b, slot, left_b.left);
            }
            carve_eight(a, left_a.left, slots, i);
            carve_eight(b, left_b.left, slots, i + simd::width);
        }
    }

    template <VoxelCoverage coverage>
    [[gnu::always_inline]] void carve_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                                             const VoxelRange& slices) {
        const SweepSeenFrom sweep = to.sweep_;
        const SimdSweep fast(sweep);
        ManyParts parts;
        const std::size_t part_count = find_parts(rows, brick_y, slices, parts);
        for (int brick_x = layer.first_x(); brick_x < layer.end_x(); ++brick_x) {
            const std::int32_t slot = layer.slot(brick_x, brick_y);
            if (slot == BoneContent::no_slot) continue;
            list_rows(parts, part_count, brick_x);
            const std::size_t count = list_voxels(std::as_const(to.bone_).fractions(slot).data());
            if (count == 0) continue;
            const glm::ivec3 brick(brick_x, brick_y, slices.first / brick_edge_voxels);
            carve_list<coverage>(sweep, fast, slot, brick * brick_edge_voxels, count);
            if (to.changes_ != nullptr) to.write_back(slot);
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

void CarveKernel::write_back(std::int32_t slot) noexcept {
    std::uint8_t* const fractions = bone_.fractions(slot).data();
    BrickChange change{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(slot)]};
    bool has_changed = false;
    const std::uint8_t* left = left_of_list();
    const Row* const end = rows_.data() + row_count_;
    for (const Row* row = rows_.data(); row < end; ++row) {
        const std::size_t x = row->first() % brick_edge_voxels;
        std::uint8_t* const brick_row = fractions + (row->first() - x);
        // All sixteen voxels of the brick's row at once: only the listed ones lose bone.
        const auto before = simd::load<Bytes>(brick_row);
        const Bytes after =
            simd::smaller(before, simd::load<Bytes>(left - x) | simd::outside(x, row->length()));
        const unsigned changed = simd::bits_of_unequal(before, after);
        if (changed != 0) {
            simd::store(brick_row, after);
            // Voxels in between are included: a gap would cost more to send.
            const auto first = static_cast<std::size_t>(std::countr_zero(changed));
            change.voxels.set_run(row->first() - x + first,
                                  static_cast<std::size_t>(std::bit_width(changed)) - first);
            has_changed = true;
        }
        left += row->length();
    }
    if (has_changed) changes_->push(change, bone_.fractions(slot));
}

void CarveKernel::hand_on_voxels() noexcept {
    if (voxels_.count > 0) sink_.take(voxels_);
    voxels_.count = 0;
}

}  // namespace osteomill
