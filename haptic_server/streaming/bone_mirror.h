// The streaming loop's own copy of the bone: edits go in, what changed and the checksum come out.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/bone/edit.h"
#include "common/wire/brick_edit.h"
#include "common/wire/running_checksum.h"

namespace osteomill {

class BoneMirror {
  public:
    explicit BoneMirror(Bone bone);

    /// Takes over a run. False if it does not fit the bone, which then stays as it was.
    bool apply(const EditRun& run);

    /// Likewise an edit as it came over the wire or out of a recording; says why not.
    std::optional<WireError> apply(const v1::BrickEdit& edit);

    /// What edits have covered since the last call, brick by brick, ascending; brings the checksum up to
    /// date.
    std::vector<BrickChange> take_changes();

    const Bone& bone() const { return bone_; }
    /// As of the last take_changes().
    std::uint64_t checksum() const { return checksum_.value(); }
    const RunningChecksum& running_checksum() const { return checksum_; }

  private:
    Bone bone_;
    RunningChecksum checksum_;
    std::map<BrickIndex, VoxelMask> changed_;  // 512 bytes and a node for each of them
};

}  // namespace osteomill
