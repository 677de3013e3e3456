// Distances within which the bone's shaders read around a point.
#pragma once

namespace osteomill {

/// Distance from a voxel, along an axis, of the farthest surface whose shading depends on it:
/// ambient_occlusion (bone_sampling.glsl) looks 16 voxels away into a map of 4-voxel blocks whose
/// interpolation reads 2 voxels beyond each; one in reserve.
inline constexpr int shading_reach_voxels = 19;
/// Distance for position and direction of a surface, which show a carve: gradient_at reads, 2 voxels away,
/// values that are smoothed over 3; one in reserve.
inline constexpr int surface_reach_voxels = 6;

}  // namespace osteomill
