// A replica of a bone that is milled elsewhere: changes go in, changed voxels and the checksum come out.
//
// A server keeps one for its clients, a client keeps one of the server's bone, and a recording one of the
// recorded bone.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/wire/frame.h"

namespace osteomill {

/// The checksum of a bone that is being edited, kept up to date brick by brick: see checksum() in bone.h.
class RunningChecksum {
  public:
    explicit RunningChecksum(const Bone& bone);

    /// To be called after the fractions of a stored brick have changed; `bone` is the one it began with.
    void update(const Bone& bone, std::int32_t slot);

    std::uint64_t value() const { return sum_; }

    /// The part of the checksum that `count` bricks from `first` on contribute, whether stored or not; `bone`
    /// is the one it began with.
    std::uint64_t sum_of(const Bone& bone, BrickIndex first, std::uint64_t count) const;

  private:
    std::vector<std::uint64_t> term_by_slot_;
    std::uint64_t sum_ = 0;
};

class BoneReplica {
  public:
    explicit BoneReplica(Bone bone);
    /// `checksum` is that of `bone`.
    BoneReplica(Bone bone, RunningChecksum checksum)
        : bone_(std::move(bone)), checksum_(std::move(checksum)) {}

    /// Takes over a change of the milling loop's, milled or restored. False if it does not fit the bone,
    /// which then stays as it was.
    [[nodiscard]] bool apply(const BrickChange& change, BrickFractions fractions);
    /// Takes over a change that came over the wire or out of a recording, where this replica may be wrong:
    /// voxels may rise. Returns why not, with the replica unchanged.
    std::variant<Correction, WireError> correct(const ChangedBrick& changed);
    /// Gives a stored brick other fractions, as when a recording is wound back.
    void set_fractions(BrickIndex brick, BrickFractions fractions);

    /// The changes since the last call: the voxels that changes covered, and those that were set to another
    /// fraction; brick by brick, ascending. A voxel that was restored is in a change of that kind, even if it
    /// changed otherwise, too; a brick may have one change of each kind.
    std::vector<BrickChange> take_changes();

    const Bone& bone() const { return bone_; }
    /// The milling loop's changes count as of the last take_changes(), all else at once.
    std::uint64_t checksum() const { return checksum_.value(); }
    const RunningChecksum& running_checksum() const { return checksum_; }

  private:
    struct Changed {
        VoxelMask milled;
        VoxelMask restored;
        bool awaits_checksum = false;  // many steps go into one brick

        VoxelMask& voxels(ChangeKind kind) { return kind == ChangeKind::milled ? milled : restored; }
    };
    Bone bone_;
    RunningChecksum checksum_;
    std::map<BrickIndex, Changed> changed_;
};

}  // namespace osteomill
