// Edits of several bricks told as what differs from a guess (see swept_guess.h): while a burr cuts, most of
// what changes follows from where it went, and what does not compresses well. Exact: unpacked, they are the
// edits that were packed, voxel by voxel.
//
// Packed: zstd of, for each brick in turn, a mask of 512 bytes (bit k of byte n: voxel 8 n + k) of the voxels
// where changed differs from the guess's; behind the last mask, brick by brick and voxel by voxel, a byte for
// each changed voxel: its new fraction less the guess's, modulo 256.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/wire/swept_guess.h"
#include "common/wire/wire_error.h"
#include "osteomill/v1/bone.pb.h"

struct ZSTD_CCtx_s;

namespace osteomill {

/// Before compression. Even where nothing compresses they fit a frame, and half a second of a link of
/// 1 Mbit/s.
inline constexpr std::size_t largest_guessed_edits_bytes = 64 * 1024;
inline constexpr std::size_t mask_bytes = brick_voxel_count / 8;

/// Changed voxels of a stored brick.
struct ChangedBrick {
    BrickIndex brick = 0;
    VoxelMask voxels{};

    bool operator==(const ChangedBrick&) const = default;
};

class GuessedEditsPacker {
  public:
    GuessedEditsPacker();

    /// The fractions that the bone has now. Without a sweep the guess is that nothing changed, and to zero.
    /// The masks and fractions must not exceed largest_guessed_edits_bytes.
    v1::GuessedEdits pack(const Bone& bone, const std::vector<ChangedBrick>& bricks,
                          const std::optional<GuessedSweep>& sweep);

  private:
    struct Free {
        void operator()(ZSTD_CCtx_s* context) const;
    };
    std::unique_ptr<ZSTD_CCtx_s, Free> context_;
    std::vector<std::uint8_t> differences_;
    std::vector<std::uint8_t> compressed_;
};

/// The edits as such, for a grid of so many bricks. Whether they fit a bone is seen when they are applied.
std::variant<std::vector<v1::BrickEdit>, WireError> unpack(const v1::GuessedEdits& message,
                                                           const glm::ivec3& size_bricks);

}  // namespace osteomill
