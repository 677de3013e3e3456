// Bricks: cubes of 16^3 voxels, the unit in which bone is stored, sent and drawn.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/bone/grid.h"

namespace osteomill {

inline constexpr int brick_edge_voxels = 16;
inline constexpr std::size_t brick_voxel_count = 4096;
/// Level of the bone's surface: half of a voxel's 255.
inline constexpr float surface_fraction = 127.5f;

/// One byte a voxel; x runs fastest, then y, then z.
using ByteBrick = std::array<std::uint8_t, brick_voxel_count>;

/// View of the fractions left of a brick's voxels, 0 (none) to 255 (all).
using BrickFractions = std::span<const std::uint8_t, brick_voxel_count>;

/// Place of a brick in its grid, counted in bricks: x + nx (y + ny z).
using BrickIndex = std::uint32_t;

/// Bricks that cover the grid along each axis; the last may reach past the grid's edge (its voxels there are
/// empty).
inline glm::ivec3 size_in_bricks(const Grid& grid) {
    return (grid.size_voxels + (brick_edge_voxels - 1)) / brick_edge_voxels;
}

inline BrickIndex brick_index(const glm::ivec3& size_bricks, const glm::ivec3& brick) {
    return static_cast<BrickIndex>(brick.x) +
           static_cast<BrickIndex>(size_bricks.x) *
               (static_cast<BrickIndex>(brick.y) +
                static_cast<BrickIndex>(size_bricks.y) * static_cast<BrickIndex>(brick.z));
}

inline glm::ivec3 brick_position(const glm::ivec3& size_bricks, BrickIndex index) {
    const auto nx = static_cast<BrickIndex>(size_bricks.x);
    const auto ny = static_cast<BrickIndex>(size_bricks.y);
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / nx / ny)};
}

/// Offset of a voxel within its brick; `voxel` is counted within the grid and is not negative.
inline std::size_t offset_in_brick(const glm::ivec3& voxel) {
    return static_cast<std::size_t>((voxel.x & 15) + 16 * ((voxel.y & 15) + 16 * (voxel.z & 15)));
}

/// The reverse: place of a voxel, counted from its brick's first; `offset` is below brick_voxel_count.
inline glm::ivec3 voxel_in_brick(std::size_t offset) {
    return {static_cast<int>(offset & 15U), static_cast<int>(offset >> 4U & 15U),
            static_cast<int>(offset >> 8U)};
}

/// A set of voxels of a brick: a bit for each, by offset.
class VoxelMask {
  public:
    /// Four rows of the brick, the first voxel in the lowest bit.
    using Word = std::uint64_t;
    static constexpr std::size_t voxels_per_word = 64;
    static constexpr std::size_t word_count = brick_voxel_count / voxels_per_word;

    bool operator[](std::size_t voxel) const {
        return (words_[voxel / voxels_per_word] >> voxel % voxels_per_word & 1u) != 0;
    }
    bool none() const { return *this == VoxelMask(); }
    bool any() const { return !none(); }
    bool all() const { return count() == brick_voxel_count; }
    std::size_t count() const {
        std::size_t sum = 0;
        for (const Word word : words_) sum += static_cast<std::size_t>(std::popcount(word));
        return sum;
    }
    /// In the order of the voxels.
    const std::array<Word, word_count>& words() const { return words_; }

    VoxelMask& set(std::size_t voxel) { return set_run(voxel, 1); }
    /// Neighbours in one row of the brick: (first % 16) + count <= 16.
    VoxelMask& set_run(std::size_t first, std::size_t count) {
        words_[first / voxels_per_word] |= ((Word{1} << count) - 1) << first % voxels_per_word;
        return *this;
    }
    VoxelMask& set_all() {
        words_.fill(~Word{0});
        return *this;
    }
    VoxelMask& set_word(std::size_t number, Word word) {
        words_[number] = word;
        return *this;
    }
    VoxelMask& operator|=(const VoxelMask& other) {
        std::ranges::transform(words_, other.words_, words_.begin(), std::bit_or<>());
        return *this;
    }
    /// Those that `other` does not hold.
    VoxelMask without(const VoxelMask& other) const {
        VoxelMask rest;
        for (std::size_t number = 0; number < word_count; ++number)
            rest.words_[number] = words_[number] & ~other.words_[number];
        return rest;
    }
    friend VoxelMask operator|(VoxelMask a, const VoxelMask& b) { return a |= b; }
    bool operator==(const VoxelMask&) const = default;

    /// Calls `visit(voxel)` for each, ascending.
    template <typename Visit>
    void for_each(Visit&& visit) const {
        for (std::size_t number = 0; number < word_count; ++number)
            for (Word rest = words_[number]; rest != 0; rest &= rest - 1)
                visit(number * voxels_per_word + static_cast<std::size_t>(std::countr_zero(rest)));
    }

  private:
    std::array<Word, word_count> words_{};
};

/// Slot of each stored brick: a hash table that costs memory for bricks that are stored, not for the grid
/// round them.
///
/// Open addressing with linear probing, at most half full, so a look-up touches one cache line nearly always.
/// Hash: Fibonacci's multiply-shift (Knuth, The Art of Computer Programming 3, 6.4), which spreads neighbours
/// along a row as far apart as can be.
class BrickTable {
  public:
    static constexpr std::int32_t no_slot = -1;

    /// A table without bricks.
    BrickTable();
    /// The brick at each position has that position as its slot. Throws std::invalid_argument, naming it, for
    /// a brick that comes twice, and for more bricks than a slot can count (2^31).
    explicit BrickTable(std::span<const BrickIndex> brick_of_slot);

    /// Slot of a brick; no_slot for every other number. Real-time safe, from any number of threads.
    std::int32_t find(BrickIndex brick) const noexcept {
        for (std::size_t place = first_place(brick);; place = (place + 1) & (entries_.size() - 1)) {
            const Entry& entry = entries_[place];
            if (entry.brick == brick || entry.slot == no_slot) return entry.slot;
        }
    }

    std::size_t memory_bytes() const noexcept { return entries_.size() * sizeof(Entry); }

  private:
    struct Entry {
        BrickIndex brick = 0;
        std::int32_t slot = no_slot;  ///< no_slot: nothing is stored at this place
    };

    std::size_t first_place(BrickIndex brick) const noexcept {
        constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;  // 2^64 / ((1 + sqrt 5) / 2), odd
        return static_cast<std::size_t>((brick * golden_ratio) >> shift_);
    }

    std::vector<Entry> entries_;  // a power of two, at least 2
    unsigned shift_ = 0;          // leaves as many bits as number the places
};

}  // namespace osteomill
