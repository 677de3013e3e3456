// A mask of a brick's voxels as bytes: bit k of byte n is voxel 8 n + k.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/bone/voxel_mask.h"

namespace osteomill {

inline constexpr std::size_t mask_bytes = brick_voxel_count / 8;

inline void append(const VoxelMask& mask, std::vector<std::uint8_t>& bytes) {
    for (const VoxelMask::Word word : mask.words())
        for (std::size_t k = 0; k < sizeof word; ++k)
            bytes.push_back(static_cast<std::uint8_t>(word >> 8 * k));
}

/// The mask in the first mask_bytes of `bytes`, which must be there.
inline VoxelMask mask_at(std::span<const std::uint8_t> bytes) {
    VoxelMask mask;
    for (std::size_t n = 0; n < VoxelMask::word_count; ++n) {
        VoxelMask::Word word = 0;
        for (std::size_t k = 0; k < sizeof word; ++k)
            word |= VoxelMask::Word{bytes[n * sizeof word + k]} << 8 * k;
        mask.set_word(n, word);
    }
    return mask;
}

}  // namespace osteomill
