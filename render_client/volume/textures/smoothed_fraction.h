// The bone's smoothed fractions, from which the shaders compute a surface's normal.
//
// A fraction rises from none to all within one voxel, so its own slope turns with the lattice: normals are
// off by 6 degrees at the 95th percentile, and light shows that as rings. Three passes of (1, 2, 1) / 4 along
// each axis, a Gaussian of 1.2 voxels, spread the rise over the voxels that a slope is measured across; then
// it is 0.9 degrees (osteomill_study render, "normals"). The fractions themselves still decide where the
// surface lies: smoothed ones lose thin walls.
//
// If bone is seen through, fractions count the more the more opaque their tissue is, so that borders between
// tissues have slopes, too, and are lit.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "render_client/volume/gl/texture.h"
#include "render_client/volume/shading_settings.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/atlas_layout.h"

namespace osteomill {

/// Distance over which a voxel's fraction affects the smoothed ones.
inline constexpr int smoothing_reach_voxels = 3;

/// The smoothing, and its memory between the passes.
class FractionSmoother {
  public:
    explicit FractionSmoother(const TransferTable& table);

    /// Smoothed fractions of a box of the bone's grid, 0 to 255, x fastest; there is no bone outside the
    /// stored bricks. Valid until the next call.
    std::span<const std::uint8_t> smooth(const Bone& bone, const VoxelBox& box);

  private:
    void count_by_opacity(const Bone& bone, const VoxelBox& box);

    VoxelCodes voxel_codes_;
    /// Share with which a voxel of each code counts, 0 to 255; empty if all count in full.
    std::vector<std::uint8_t> share_by_code_;
    std::vector<std::uint8_t> fraction_;  ///< of the box and a border
    std::vector<std::uint8_t> code_;      ///< likewise
    std::vector<std::uint16_t> sums_along_x_, sums_along_xy_;
    std::vector<std::uint8_t> smoothed_;
};

/// The texture of smoothed fractions, placed as the fractions are, kept up to date round carved voxels.
class SmoothedTexture {
  public:
    /// Smooths all of the bone. Throws gl::NoTextureMemory if the driver has no memory for a byte a voxel.
    SmoothedTexture(const Bone& bone, const TransferTable& table, const AtlasLayout& places);
    /// Takes a texture of the size that the places have, of VoxelFormat::interpolated_byte; see fill.
    SmoothedTexture(const TransferTable& table, gl::Texture3D texture)
        : smoother_(table), texture_(std::move(texture)) {}

    /// Smooths all of the bone. Pass changes made meanwhile to update afterwards.
    Steps fill(const Bone& bone, const AtlasLayout& places);

    /// Smooths again all that a change of these voxels affects. `places` are those of the constructor.
    void update(const Bone& bone, AtlasLayout& places, std::span<const VoxelBox> changed);

    const gl::Texture3D& texture() const { return texture_; }

  private:
    void smooth(const Bone& bone, const PlacedVoxels& placed);

    FractionSmoother smoother_;
    gl::Texture3D texture_;
};

}  // namespace osteomill
