// Boxes in the patient: the space that an image covers, and the part of it that becomes bone.
#pragma once

#include <glm/vec3.hpp>
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

}  // namespace osteomill
