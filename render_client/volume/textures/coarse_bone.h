// A coarser copy of a bone that exceeds the graphics memory: each of its voxels stands for 2^3, 4^3 or 8^3 of
// the bone's.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "render_client/volume/steps.h"

namespace osteomill {

inline constexpr int coarsest = 8;

/// The grid over the same space with voxels `coarsening` times as long; covers the bone's grid whole.
Grid coarse_grid(const Grid& grid, int coarsening);

/// Bricks of the coarse grid in which bricks of the bone are stored, ascending.
std::vector<BrickIndex> coarse_bricks(const BoneContent& content, int coarsening);

class CoarseBone {
  public:
    /// `coarsening` is 2, 4 or 8. A coarse voxel's fraction is the mean of the bone's; its stiffness and its
    /// tissue are those of the voxel among them that was fullest.
    CoarseBone(const Bone& fine, int coarsening);
    /// Without contents; fill() copies the bone.
    explicit CoarseBone(int coarsening) : coarsening_(coarsening) {}

    /// Copies the bone, once. Pass bricks that change meanwhile to update afterwards.
    Steps fill(const Bone& fine);

    /// Follows changes of the fine bone (that of the constructor, milled or refilled since). Returns the
    /// changes of this copy, ascending; valid until the next call.
    std::span<const BrickChange> update(const Bone& fine, std::span<const BrickChange> changes);

    /// Only after fill().
    const Bone& bone() const { return *bone_; }

  private:
    int coarsening_;
    std::optional<Bone> bone_;
    std::vector<BrickChange> changed_;
};

}  // namespace osteomill
