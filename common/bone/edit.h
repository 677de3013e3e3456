// Edits: what a milling step changed, as runs of new fractions. The same edits drive network, texture and
// metrics.
#pragma once

#include <array>
#include <cstdint>

#include "common/bone/bone.h"

namespace osteomill {

/// New fractions of 1 to 16 neighbouring voxels of one row (along x) of one brick. Values are absolute, so a
/// later run overrides an earlier one and applying a run twice changes nothing. A plain value of 24 bytes: it
/// goes through lock-free queues.
struct EditRun {
    BrickIndex brick = 0;
    std::uint16_t first_voxel = 0;  ///< offset in the brick
    std::uint8_t count = 0;         ///< the run stays within its row: (first_voxel % 16) + count <= 16
    std::array<std::uint8_t, 16> fraction{};  ///< beyond `count`: anything
};

/// Where a milling step reports its edits. Real-time safe: never blocks, allocates or throws.
class EditSink {
  public:
    virtual ~EditSink() = default;
    virtual void push(const EditRun& run) noexcept = 0;
};

enum class EditOutcome { applied, no_such_brick, bad_run, raises_fraction };

/// Writes a run into the bone. A run outside the stored bricks, past its row, of no voxel, or that would
/// raise a fraction is refused whole and the bone stays as it was.
EditOutcome apply(const EditRun& run, Bone& bone);

}  // namespace osteomill
