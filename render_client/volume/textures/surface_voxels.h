// Surface voxels, shaded one by one as in the published system.
//
// A voxel is inside if at least half of it is bone. An inside voxel with at least one of its 26 neighbours
// outside is a surface voxel. Its normal is the normalised sum over its neighbours of the direction to them,
// weighted by the gradient along it: the difference of the smoothed fractions over the distance. Its colour
// is Phong's without the specular part, under the lights of lighting.h. Points outside the bone's grid are
// outside.
//
// The published sum is over the neighbours outside alone, with unsmoothed CT numbers. The set of those
// neighbours changes from voxel to voxel: normals of a ball of 25 voxels are then off by 5 degrees in the
// median and 28 at the 95th percentile, which is seen as rings. With all neighbours and smoothed fractions it
// is 0.5 and 0.8 (osteomill_study render, normals).
//
// A bit marks each voxel that is outside. A 64-bit word holds 62 voxels of a row and one beyond each end, so
// that surface voxels are found a row at a time.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_uint4_sized.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render_client/volume/gl/texture.h"
#include "render_client/volume/shading_settings.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/atlas_layout.h"
#include "render_client/volume/textures/smoothed_fraction.h"

namespace osteomill {

/// Table of the light on a white surface of any direction, from the lights of lighting.h, to shade thousands
/// of voxels on the CPU between two frames. Directions are in an octahedral map (Cigolle et al., "A survey of
/// efficient representations for independent unit vectors", 2014), so near each other that a byte of the
/// picture is off by seven at most, by less than one in the mean.
class LightTable {
  public:
    LightTable();

    /// Display RGB of an open white surface; it exceeds 1 if a white surface is overexposed. `outward` need
    /// not be unit but must not be zero. Since the display's curve is a power, that of a colour is the
    /// product of this and display(colour).
    glm::vec3 towards(const glm::ivec3& outward) const;

  private:
    static constexpr int edge = 128;
    std::vector<glm::u8vec4> lights_;  ///< bytes, so that they stay in the cache; four, to be aligned
};

/// A texel: display RGB times alpha, and alpha, which is 255 for a surface voxel and 0 for any other. So
/// interpolated colour over interpolated alpha is the mean colour of the surface voxels nearby.
struct SurfaceTexel {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;

    bool operator==(const SurfaceTexel&) const = default;
};

class SurfaceShader {
  public:
    explicit SurfaceShader(const TransferTable& table);

    /// Texels of a box of the bone's grid, x fastest. Valid until the next call.
    const std::vector<SurfaceTexel>& shade(const Bone& bone, const VoxelBox& box);

  private:
    /// Shades columns first_x to first_x + columns of the box, at most 62.
    void shade_columns(const glm::ivec3& size, int first_x, int columns);
    /// Six times the sum along which the normal points.
    glm::ivec3 outward(const std::uint8_t* own_smoothed) const;
    SurfaceTexel texel(const glm::ivec3& outward, std::uint8_t code) const;

    VoxelCodes voxel_codes_;
    std::array<glm::vec3, 256> display_by_code_{};  ///< colours, 0 to 255
    LightTable light_;
    FractionSmoother smoother_;

    // State of the call under way, for the box and a border of one voxel.
    std::vector<std::uint8_t> fraction_;
    std::vector<std::uint8_t> code_;      ///< of the box alone
    std::vector<std::uint64_t> outside_;  ///< by row: less than half full
    std::size_t rows_per_layer_ = 0;
    std::span<const std::uint8_t> smoothed_;
    /// Offsets in smoothed_ to 13 neighbours, one of each opposite pair.
    std::array<std::ptrdiff_t, 13> offsets_{};
    std::vector<SurfaceTexel> texels_;
};

/// The texture of shaded surface voxels over a bone's box, kept up to date round carved voxels.
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
