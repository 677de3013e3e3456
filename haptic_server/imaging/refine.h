// From a scan as it was taken to the bone's own grid: isotropic, axis-aligned in LPS, 16-bit HU.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "haptic_server/imaging/hu_volume.h"
#include "haptic_server/imaging/itk_image.h"
#include "haptic_server/imaging/progress.h"

namespace osteomill {

/// An axis-aligned box, patient LPS, mm.
struct Region {
    glm::dvec3 low_mm{0.0};
    glm::dvec3 high_mm{0.0};
};

/// The axis-aligned box that a scan's voxel centres span.
Region extent_of(const ScanImage& scan);

/// What both share; nullopt where they do not meet.
std::optional<Region> intersection(const Region& a, const Region& b);

/// The grid of the given spacing that fills a region, its first voxel centre at the region's low corner.
Grid grid_of(const Region& region, double spacing_mm);

/// Memory that refine needs at its peak beside the scan itself.
double refine_memory_bytes(const ScanImage& scan, const Region& region, double spacing_mm);

/// Resamples a scan to a grid. Where the grid is finer, by cubic B-splines (Unser 1999), held within the
/// scan's own range, since splines overshoot at metal and air; along axes where it is more than 1.5 times
/// coarser, after a Gaussian of half the grid's spacing. Outside the scan: air, -1000 HU. HU beyond 16 bits
/// are clamped.
HuVolume refine(const ScanImage& scan, const Grid& grid, const Progress& progress);

/// Sets to air what is farther than two voxels from any voxel at or above the threshold: HU near the surface
/// stay as they were.
void clear_far_from_bone(HuVolume& volume, double threshold_hu);

}  // namespace osteomill
