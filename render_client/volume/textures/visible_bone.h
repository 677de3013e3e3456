// The bone without the voxels that a transfer function hides: a copy whose fractions are reduced to the
// visible part of each voxel. It is drawn like any other bone, and hidden voxels are skipped like empty
// space.
//
// By stiffness, the stiffest of a voxel and its 26 neighbours decides (copy_stiffest_codes), or a surface
// would be full of pits; by tissue, the voxel's own label decides.
#pragma once

#include <optional>
#include <span>

#include "common/bone/brick_change.h"
#include "render_client/volume/shading_settings.h"
#include "render_client/volume/steps.h"

namespace osteomill {

class VisibleBone {
  public:
    VisibleBone(const Bone& bone, const TransferTable& table);
    /// Without contents; fill() copies the bone.
    explicit VisibleBone(const TransferTable& table);

    /// Copies all of the bone, once. Pass bricks that change meanwhile to follow afterwards.
    Steps fill(const Bone& bone);

    /// Copies the changed bricks of `bone`, the bone of the constructor in its present state.
    void follow(const Bone& bone, std::span<const BrickChange> changes);

    /// Only after fill().
    const Bone& bone() const { return *visible_; }

  private:
    /// Copies the shown part of a brick.
    void take_over(const Bone& bone, std::int32_t slot, std::span<std::uint8_t, brick_voxel_count> shown);

    VoxelCodes voxel_codes_;
    std::array<std::uint8_t, 256> shown_part_;
    std::optional<Bone> visible_;
    ByteBrick codes_{};  ///< of the brick that is taken over
};

/// Whether this look hides any bone at all; if not, the bone itself can be drawn.
bool hides_bone(const TransferTable& table);

}  // namespace osteomill
