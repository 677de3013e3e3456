// Changes of the bone that a client has yet to be sent, brick by brick, each in its turn.
//
// The turn goes round the grid: after a brick comes the next above it that is waiting, and after the last
// the first. So a brick waits for each other one at most once, even if bricks before it keep changing
// faster than the client reads.
//
// Bounded: one entry of about 60 bytes for each stored brick that is waiting, and a mask of 512 bytes for
// the first `most_masks` of them. Beyond these a brick is sent whole.
#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include "common/bone/brick_change.h"

namespace osteomill {

class PendingChanges {
  public:
    /// 2 MiB of masks: far more bricks than a burr touches while a network hiccups.
    static constexpr std::size_t most_masks = 4096;

    /// Once part of a brick was restored, all of it that waits goes as restored: the client may know older
    /// values than those from which milling went on.
    void add(const BrickChange& change);
    void add_whole(BrickIndex brick);

    bool empty() const { return waiting_.empty(); }
    std::size_t bricks() const { return waiting_.size(); }
    std::size_t masks() const { return masks_; }

    /// Whose turn it is; not to be called on an empty set.
    BrickChange next() const;
    /// The brick of next() has been sent: the turn goes on.
    void sent();

  private:
    struct Waiting {
        std::unique_ptr<VoxelMask> voxels{};  ///< null: the whole brick
        ChangeKind kind = ChangeKind::milled;
    };
    std::map<BrickIndex, Waiting>::const_iterator turn() const;

    std::map<BrickIndex, Waiting> waiting_;
    std::size_t masks_ = 0;
    BrickIndex turn_ = 0;  // bricks from here on come first
};

}  // namespace osteomill
