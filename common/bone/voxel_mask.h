// A set of voxels of a brick: a bit for each, by offset.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "common/bone/brick.h"

namespace osteomill {

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

}  // namespace osteomill
