// A snapshot of the bone in and out of messages, in pieces that fit a frame.
//
// Everything that arrives is checked before it is used; anything wrong is refused in one line.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/bone_builder.h"
#include "common/wire/frame.h"
#include "common/wire/zstd_compressor.h"

// Named here, because bone.pb.h takes long to parse.
namespace osteomill::v2 {
class SnapshotBegin;
class SnapshotBricks;
class SnapshotEnd;
}  // namespace osteomill::v2

namespace osteomill {

/// The largest bone that is sent, all channels together; the grid round it costs nothing. Bone compresses a
/// thousandfold where it is uniform, so a snapshot's own size bounds nothing. At 0.1 mm and with three
/// channels it is 1400 cm^3 of bone, twice a skull.
inline constexpr std::size_t most_bytes_of_bone = std::size_t{4} << 30U;

/// Uncompressed channels in one SnapshotBricks. Compressed they fit a frame even if nothing compresses.
inline constexpr std::size_t largest_snapshot_piece_bytes = 120 * 1024;

/// Throws std::invalid_argument if the bone is larger than that.
void require_sendable(const Bone& bone);

v2::SnapshotBegin snapshot_begin(const Bone& bone);

/// Packs bricks for a snapshot, piece by piece, so that a snapshot can be taken from a bone that changes
/// meanwhile: see the streaming session.
class SnapshotPacker {
  public:
    SnapshotPacker();

    /// The bricks from `first_slot` on, as many as fit; at least one. `first_slot` must be a stored brick's.
    v2::SnapshotBricks pack(const Bone& bone, std::size_t first_slot);

  private:
    ZstdCompressor compressor_;
    std::vector<std::uint8_t> channels_;
};

/// Puts a bone together from the messages of a snapshot.
class SnapshotAssembler {
  public:
    /// Begins a snapshot, or says why that grid cannot be had.
    static std::variant<SnapshotAssembler, WireError> begin(const v2::SnapshotBegin& message);

    /// Adds bricks. After an error the assembler is of no further use.
    std::optional<WireError> add(const v2::SnapshotBricks& message);

    /// The bone, if every announced brick has come and the checksum holds. The assembler is spent.
    std::variant<Bone, WireError> finish(const v2::SnapshotEnd& message) &&;

    std::uint32_t bricks_received() const { return received_; }
    std::uint32_t bricks_announced() const { return announced_; }

  private:
    SnapshotAssembler(BoneBuilder builder, const v2::SnapshotBegin& message, const glm::ivec3& size_bricks);

    BoneBuilder builder_;
    glm::ivec3 size_bricks_;
    bool heterogeneous_;
    bool labelled_;
    std::uint32_t announced_;
    std::uint32_t received_ = 0;
    std::int64_t last_brick_ = -1;
    std::vector<std::uint8_t> channels_;
};

}  // namespace osteomill
