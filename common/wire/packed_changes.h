// Changes of several bricks in one message, compressed together: how changes cross the wire and lie in a
// recording. Exact: unpacked, they are the changes that were packed, voxel by voxel.
//
// Packed: zstd of, for each brick in turn, its mask of 512 bytes (bit k of byte n: voxel 8 n + k is changed);
// behind the last mask, brick by brick and voxel by voxel, the new fraction of each changed voxel. Each
// message stands alone, so that one may be lost.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick.h"
#include "common/bone/brick_change.h"
#include "common/wire/frame.h"
#include "common/wire/zstd_compressor.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill {

// A mask of a brick's voxels as bytes: bit k of byte n is voxel 8 n + k.

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

/// Before compression. Even if nothing compresses they fit a frame, and half a second of a link of
/// 1 Mbit/s.
inline constexpr std::size_t largest_packed_changes_bytes = 64 * 1024;

class ChangePacker {
  public:
    ChangePacker();

    /// With the fractions that the bone has now. The bricks are stored; masks and fractions must not exceed
    /// largest_packed_changes_bytes.
    v2::PackedChanges pack(const Bone& bone, const std::vector<BrickChange>& changes);

  private:
    ZstdCompressor compressor_;
    std::vector<std::uint8_t> content_;
};

/// Appends the changes that were packed, for a grid of so many bricks. Whether they fit a bone is seen when
/// they are applied. An error says what does not add up.
std::optional<WireError> unpack(const v2::PackedChanges& message, ChangeKind kind,
                                const glm::ivec3& size_bricks, std::vector<ChangedBrick>& changes);

}  // namespace osteomill
