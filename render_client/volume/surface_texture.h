// The texture of shaded surface voxels over a bone's box, kept up to date round what is carved.
#pragma once

#include <span>

#include "render_client/volume/gl/texture3d.h"
#include "render_client/volume/surface_voxels.h"

namespace osteomill {

class SurfaceTexture {
  public:
    /// Shades the whole box (of the bone's grid, whole bricks). Throws std::runtime_error where the driver
    /// has no memory for its four bytes a voxel.
    SurfaceTexture(const Bone& bone, const LookTable& table, const VoxelBox& box);

    /// Shades again what a change of these bricks can have changed: themselves and one voxel round them.
    void update(const Bone& bone, std::span<const BrickIndex> dirty);

    const gl::Texture3D& texture() const { return texture_; }

  private:
    void shade(const Bone& bone, const VoxelBox& box);

    LookTable table_;
    VoxelBox box_;
    gl::Texture3D texture_;
};

}  // namespace osteomill
