// The surface of a soft structure, such as a nerve, for its picture: of its voxels without bone.
//
// Constrained elastic surface nets (Gibson 1998, MICCAI, LNCS 1496): a vertex in each cell of eight
// neighbouring voxels that are not all alike, quads between them, and vertices that are moved to the mean of
// their neighbours, but not out of their cells. So the surface is smooth, closed and within a voxel of the
// structure's. A large structure has coarser voxels, so that no surface has more than some hundred thousand
// vertices.
#pragma once

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"
#include "render_client/volume/tool/triangles.h"

namespace osteomill {

// The region about a structure that a virtual fixture begins with, for the picture of its border.

/// The places within `distance_mm` of the structure, on a grid of their own: as fine as the structure's, or
/// coarser if that would be more than some million voxels. Empty for an empty structure. Allocates.
StructureMask region_about(const StructureMask& structure, double distance_mm);

/// The voxels of a structure that, as far as the bone shows, were never bone: they hold none now and, if the
/// bone has a stiffness for each voxel, have no stiffness.
StructureMask soft_part(const StructureMask& structure, const Bone& bone);

struct StructureSurface {
    Triangles triangles;        ///< about the origin
    glm::dvec3 origin_mm{0.0};  ///< patient LPS
};

/// In linear RGB; no triangles for an empty structure.
StructureSurface surface_of(const StructureMask& structure, const glm::vec3& colour);

}  // namespace osteomill
