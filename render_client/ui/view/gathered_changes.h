// Changes of a bone that are yet to be shown, brick by brick: a later change of a brick joins the earlier
// one.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "common/bone/brick_change.h"

namespace osteomill {

class GatheredChanges {
  public:
    void add(std::span<const BrickChange> changes) {
        for (const BrickChange& change : changes) voxels_[change.brick] |= change.voxels;
    }
    bool empty() const { return voxels_.empty(); }
    void clear() { voxels_.clear(); }

    /// Takes out the first bricks, at most so many, ascending. Whether they rose or fell is forgotten.
    std::vector<BrickChange> take(std::size_t most_bricks) {
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
