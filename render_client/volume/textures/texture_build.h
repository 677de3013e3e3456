// Build of a bone's textures in steps of a few milliseconds: a head of 2048^3 voxels takes seconds, and
// meanwhile the drawing thread must keep the window responsive.
//
// The bone may be carved between steps. A step reads it in its present state, so all changes since the
// beginning must be passed to BoneTextures::update at the end; the textures are then as if made of the final
// bone. (Two things may differ: distances of empty space may be shorter than necessary and, in a coarser
// copy, voxels keep the code of the fullest voxel at the time of reading.)
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

class TextureBuild {
  public:
    /// `bone` must keep its address, and everything except its fractions, while there are steps. A tissue
    /// without voxels makes nothing translucent: all bone would be drawn the slower way for it. `storage`
    /// makes the textures' memory; null: the steps do, however long that takes. Throws std::invalid_argument
    /// for an invalid transfer function.
    TextureBuild(const Bone& bone, std::vector<TissueColour> tissues, const ShadingSettings& look,
                 const TextureLimits& limits, gl::StorageThread* storage = nullptr);
    TextureBuild(const TextureBuild&) = delete;
    TextureBuild& operator=(const TextureBuild&) = delete;

    /// Goes on by a step. False: all is made. Throws std::runtime_error, naming sizes, as BoneTextures does.
    bool step() { return steps_.step(); }
    /// 0 to 1.
    double done() const { return steps_.done(); }

    /// The plan of the textures, once it is known.
    const std::optional<TexturePlan>& plan() const { return plan_; }
    /// Whether the driver had no memory for a better plan.
    bool has_settled_for_less() const { return has_settled_for_less_; }

    /// After the last step, once.
    BoneTextures take() { return std::move(*made_); }
    BoneTextures all_at_once();

  private:
    Steps build(const Bone& bone);
    Steps make_absent_opaque(const Bone& bone);

    std::vector<TissueColour> tissues_;
    ShadingSettings look_;
    TextureLimits limits_;
    gl::StorageThread* storage_;
    std::optional<TexturePlan> plan_;
    bool has_settled_for_less_ = false;
    std::optional<BoneTextures> made_;
    Steps steps_;  // last, since it works on the others
};

}  // namespace osteomill
