// The CT for display, converted to and from messages, in pieces that fit a frame.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

#include "common/bone/ct_volume.h"
#include "common/wire/frame.h"
#include "common/wire/zstd_compressor.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill {

/// A CT on a finer grid is not sent: 16 MB.
inline constexpr std::size_t most_ct_voxels = std::size_t{1} << 23U;

class CtPacker {
  public:
    CtPacker() : compressor_(3) {}
    /// The piece from that voxel on; `first_voxel` goes to the one after it, at the end to the number of
    /// voxels. The first piece carries the grid.
    v2::CtPiece pack(const CtVolume& ct, std::size_t& first_voxel);

  private:
    ZstdCompressor compressor_;
};

class CtAssembler {
  public:
    /// A piece with a grid begins anew. Nothing until the last has come. Refuses pieces out of order, a grid
    /// that is too large or impossible, and data that cannot be unpacked; it is then empty again.
    std::variant<std::shared_ptr<const CtVolume>, WireError> take(const v2::CtPiece& piece);

  private:
    std::shared_ptr<CtVolume> ct_;
    std::size_t next_voxel_ = 0;
};

}  // namespace osteomill
