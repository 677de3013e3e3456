// Changed voxels of one brick: what says, from the carve to the picture, where the bone has changed.
//
// How it has changed is in a brick of fractions that goes with the change: the voxels of the mask hold what
// is left of them, the others anything. These values are absolute, so a later change overrides an earlier
// one, and a change that is applied twice does no more than once.
#pragma once

#include "common/bone/bone.h"
#include "common/bone/voxel_mask.h"

namespace osteomill {

struct BrickChange {
    BrickIndex brick = 0;
    VoxelMask voxels{};

    bool operator==(const BrickChange&) const = default;
};

/// Where a milling step reports what it changed. Real-time safe: never blocks, allocates or throws.
class ChangeSink {
  public:
    virtual ~ChangeSink() = default;
    /// `fractions`: of the change's brick, as they are now.
    virtual void push(const BrickChange& change, BrickFractions fractions) noexcept = 0;
};

/// For whoever wants the bone only.
class ForgottenChanges final : public ChangeSink {
  public:
    void push(const BrickChange&, BrickFractions) noexcept override {}
};

/// Gives the voxels of the change what `fractions` has for them. False, with the bone as it was, where the
/// brick is not stored or a voxel would rise.
[[nodiscard]] bool apply(const BrickChange& change, BrickFractions fractions, Bone& bone);

}  // namespace osteomill
