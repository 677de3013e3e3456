// The voxel bone of a site.
#pragma once

#include "common/bone/bone.h"
#include "studies/stability/sites/site.h"

namespace osteomill::study {

inline constexpr double site_voxel_mm = 0.1;

/// A voxel's fraction falls from all to nothing over a voxel about the shape's surface.
Bone site_bone(const SiteShape& shape);

}  // namespace osteomill::study
