// The bone without what a transfer function hides: a copy whose fractions are lowered to the part of each
// voxel that is shown. What draws a bone draws this one as it would any other, and skips what is hidden as it
// skips empty space.
//
// A voxel at the edge of bone mixes bone and air, and its CT number makes it softer than the bone in it.
// Taken at its word it would be hidden here and shown there, and leave a surface full of pits. So what
// decides by stiffness is the stiffest of a voxel and its 26 neighbours; that of tissues is the voxel's own
// label.
#pragma once

#include <span>

#include "common/bone/brick_change.h"
#include "render_client/volume/shading_settings.h"

namespace osteomill {

class VisibleBone {
  public:
    VisibleBone(const Bone& bone, const LookTable& table);

    /// Takes over the bricks that changed of `bone`, which is the bone of the constructor, carved since.
    void follow(const Bone& bone, std::span<const BrickChange> changes);

    const Bone& bone() const { return visible_; }

  private:
    void take_over(const Bone& bone, std::int32_t slot);

    void take_codes(const Bone& bone, std::int32_t slot);

    std::optional<BoneChannel> channel_;
    std::array<std::uint8_t, 256> shown_part_;
    Bone visible_;
    ByteBrick codes_{};  ///< of the brick that is taken over
};

/// Whether this look hides any bone at all; where not, the bone itself can be drawn.
bool hides_bone(const LookTable& table);

}  // namespace osteomill
