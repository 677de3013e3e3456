// Part of an image that a region needs, with its axes turned to patient LPS if that only means swapping and
// reversing them.
#pragma once

#include <span>

#include "imaging/formats/source_image.h"
#include "imaging/resampling/region.h"

namespace osteomill {

/// A box of voxels in an image's own axes, both ends included.
struct ImageBox {
    glm::ivec3 first{0};
    glm::ivec3 last{0};
};

/// Voxels that a region needs: those in it and `margin_voxels` around, along the image's axes, within the
/// image.
ImageBox voxels_for(const SourceImage& image, const ScanRegion& region, const glm::ivec3& margin_voxels);

std::uint64_t voxel_count(const ImageBox& box);

/// Whether every axis of the image runs along one of patient LPS, to or fro.
bool is_axis_aligned(const SourceImage& image);

/// The part that a box becomes. If the image is axis-aligned, the part's direction is the identity: its
/// voxels run left, posterior, superior.
SourceImage part_of(const SourceImage& image, const ImageBox& box);

/// Copies the values of slice k that lie within the box to their place in the part that part_of gives; a
/// slice outside changes nothing.
void put_slice(const SourceImage& image, const ImageBox& box, int k, std::span<const float> slice,
               std::span<float> part_values);

}  // namespace osteomill
