// The texture of shaded surface voxels over a bone's box, kept up to date round carved voxels.
#pragma once

#include <span>
#include <utility>

#include "render_client/volume/gl/texture3d.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/atlas_layout.h"
#include "render_client/volume/textures/surface_voxels.h"

namespace osteomill {

class SurfaceTexture {
  public:
    /// Shades all of the bone. Throws gl::NoTextureMemory if the driver has no memory for four bytes a voxel.
    SurfaceTexture(const Bone& bone, const TransferTable& table, const AtlasLayout& places);
    /// Takes a texture of the size that the places have, of VoxelFormat::interpolated_rgba; see fill.
    SurfaceTexture(const TransferTable& table, gl::Texture3D texture)
        : shader_(table), texture_(std::move(texture)) {}

    /// Shades all of the bone. Pass changes made meanwhile to update afterwards.
    Steps fill(const Bone& bone, const AtlasLayout& places);

    /// Shades again the changed voxels and those near them. `places` are those of the constructor.
    void update(const Bone& bone, AtlasLayout& places, std::span<const VoxelBox> changed);

    const gl::Texture3D& texture() const { return texture_; }

  private:
    void shade(const Bone& bone, const PlacedVoxels& placed);

    SurfaceShader shader_;
    gl::Texture3D texture_;
};

}  // namespace osteomill
