// Boxes in the patient: the space that an image covers, and the part of it that becomes bone.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "common/bone/grid.h"
#include "imaging/formats/source_image.h"

namespace osteomill {

/// An axis-aligned box, patient LPS, mm.
struct ScanRegion {
    glm::dvec3 low_mm{0.0};
    glm::dvec3 high_mm{0.0};

    bool operator==(const ScanRegion&) const = default;
};

/// Smallest box around the centres of an image's voxels, however the image is turned.
ScanRegion extent_of(const SourceImage& image);

/// "x0,y0,z0,x1,y1,z1" as --region takes it. Throws std::invalid_argument unless it is six numbers, each of
/// the second three greater than its partner.
ScanRegion parse_region(const std::string& text);

/// The common part. Throws std::invalid_argument, naming both boxes, if there is none.
ScanRegion clip(const ScanRegion& region, const ScanRegion& extent);

/// "x0,y0,z0,x1,y1,z1" with a tenth of a mm, which parse_region reads.
std::string to_text(const ScanRegion& region);

/// The grid of cubes whose first centre is the region's low corner and whose last lie within it. Throws
/// std::invalid_argument if an axis would have more than 65536 voxels.
Grid grid_over(const ScanRegion& region, double spacing_mm);

// Part of an image that a region needs, with its axes turned to patient LPS if that only means swapping and
// reversing them.

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
