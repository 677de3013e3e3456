// Cuts the part of an image that a region needs, and turns its axes to patient LPS where that only means
// swapping and reversing them.
#pragma once

#include "haptic_server/imaging/region.h"
#include "haptic_server/imaging/source_image.h"

namespace osteomill {

/// A box of voxels in an image's own axes, both ends included.
struct VoxelBox {
    glm::ivec3 first{0};
    glm::ivec3 last{0};
};

/// Voxels that a region needs: those in it and `margin_voxels` around, within the image.
VoxelBox voxels_for(const SourceImage& image, const Region& region, int margin_voxels);

std::uint64_t voxel_count(const VoxelBox& box);

/// Whether every axis of the image runs along one of patient LPS, to or fro.
bool is_axis_aligned(const SourceImage& image);

/// The voxels of the box. Where the image is axis-aligned the part's direction is the identity: its voxels
/// run left, posterior, superior.
SourceImage cut(const SourceImage& image, const VoxelBox& box);

}  // namespace osteomill
