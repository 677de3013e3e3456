// Surface voxels, shaded one by one as the published system did it.
//
// A voxel is inside where at least half of it is bone. An inside voxel with at least one of its 26 neighbours
// outside is a surface voxel. Its normal is the normalised sum over those neighbours of the direction to
// them, weighted by the gradient along it: the difference of the fractions over the distance. Its colour is
// Phong's without the specular part, under the lights of lighting.h. Points outside the bone's grid are
// outside.
#pragma once

#include <cstdint>
#include <vector>

#include "render_client/volume/bone_look.h"

namespace osteomill {

/// A texel: display RGB times alpha, and alpha, which is 255 for a surface voxel and 0 for any other. So
/// interpolated colour over interpolated alpha is the mean colour of the surface voxels nearby.
struct SurfaceTexel {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;

    bool operator==(const SurfaceTexel&) const = default;
};

/// Texels of a box of the bone's grid, x fastest.
std::vector<SurfaceTexel> shade_surface_voxels(const Bone& bone, const LookTable& table, const VoxelBox& box);

}  // namespace osteomill
