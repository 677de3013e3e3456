// Clearing of values far from bone, so that a bone file is small.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "common/bone/grid.h"

namespace osteomill {

/// HU within this many voxels of bone stay as they are, because the surface's gradient and coverage are
/// computed from them.
inline constexpr int kept_voxels_around_bone = 2;

class NearBone {
  public:
    /// Remembers the `held_slices` slices that were added last, and no more.
    NearBone(const Grid& grid, double threshold_hu, int held_slices);

    /// Adds the bone of slice z. Different slices may be added from different threads at once.
    void look_at(int z, std::span<const std::int16_t> hu);
    /// Sets every voxel of slice z that is further than kept_voxels_around_bone (along any axis) from one
    /// that reaches the threshold to air, -1000 HU. All slices within that of z must have been added, and be
    /// remembered. Different slices may be cleared at once.
    void clear_far(int z, std::span<std::int16_t> hu) const;
    /// Voxels that reach the threshold, so far.
    std::uint64_t bone_voxels() const { return bone_voxels_; }

  private:
    using Mask = std::vector<std::uint8_t>;
    const Mask& mask(int z) const { return masks_[static_cast<std::size_t>(z) % masks_.size()]; }

    Grid grid_;
    double threshold_hu_;
    std::vector<Mask> masks_;  // each slice's bone, widened within the slice
    std::atomic<std::uint64_t> bone_voxels_{0};
};

}  // namespace osteomill
