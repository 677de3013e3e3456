// Changes of several bricks in one message, compressed together: how changes cross the wire and lie in a
// recording. Exact: unpacked, they are the changes that were packed, voxel by voxel.
//
// Packed: zstd of, for each brick in turn, its mask of 512 bytes (bit k of byte n: voxel 8 n + k is changed);
// behind the last mask, brick by brick and voxel by voxel, the new fraction of each changed voxel. Each
// message stands alone, so that one may be lost.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/wire/mask_bytes.h"
#include "common/wire/wire_error.h"
#include "common/wire/zstd_compressor.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill {

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
