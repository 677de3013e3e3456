// Test whether the burr is in view: its centre lies in the picture, and no bone hides it.
//
// No bone hides it if the straight line from the eye to the burr's centre meets no bone surface, which is
// where half a voxel is left (bone_ray.h). A tissue drawn with less than half of its colour (opacity) hides
// nothing. Neither does the handpiece, which is not recorded. The picture's height is the viewpoint's field
// of view; its width is not recorded and is assumed to be 16 / 9 of the height.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "common/session/viewpoint.h"

namespace osteomill {

inline constexpr double taken_picture_width = 16.0 / 9.0;  ///< of its height

/// `burr_mm`: its centre, patient LPS. An eye at the very place of the burr sees it.
bool is_burr_in_view(const Bone& bone, const std::vector<Tissue>& tissues, const Viewpoint& view,
                     const glm::dvec3& burr_mm);

}  // namespace osteomill
