// Changed voxels of a bone, brick by brick: a later change of a brick joins the earlier one. Whether voxels
// rose or fell is forgotten.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "common/bone/brick_change.h"

namespace osteomill {

class GatheredChanges {
  public:
    /// The gathered voxels of a brick, to add to.
    VoxelMask& voxels(BrickIndex brick) { return voxels_[brick]; }
    void add(const BrickChange& change) { voxels(change.brick) |= change.voxels; }
    void add(std::span<const BrickChange> changes) {
        for (const BrickChange& change : changes) add(change);
    }
    bool empty() const { return voxels_.empty(); }
    void clear() { voxels_.clear(); }

    /// Takes out the first bricks, at most so many, ascending.
    std::vector<BrickChange> take(std::size_t most_bricks = std::numeric_limits<std::size_t>::max()) {
        std::vector<BrickChange> taken;
        while (!voxels_.empty() && taken.size() < most_bricks) {
            taken.push_back({voxels_.begin()->first, voxels_.begin()->second});
            voxels_.erase(voxels_.begin());
        }
        return taken;
    }

  private:
    std::map<BrickIndex, VoxelMask> voxels_;
};

}  // namespace osteomill
