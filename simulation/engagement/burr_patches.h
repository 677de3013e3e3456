// The patches of a burr's surface of which an engagement map is made, with the force that each would cut.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill {

/// Burr axes; forces are for bone of relative stiffness 1.
struct BurrPatch {
    glm::dvec3 normal;
    /// From radius_mm() along the normal to the patch: zero for a ball.
    glm::dvec3 beside_mm;
    glm::dvec3 cutting_n_s_per_mm;  ///< as of an EngagedPatch
    glm::dvec3 edge_n;              ///< likewise
    double area_mm2;
};

/// Rings about the spindle, 16 patches a ring, each ring turned against the next by half a patch; 768 to 1024
/// patches, about 1.5 voxels wide if so many suffice. A ball's rings are equal in angle; those of another
/// head divide the length and the turn of its outline evenly. 1/r is its mean over the ring: (asin z2 - asin
/// z1) / (z2 - z1) / R for a ball's ring from z1 to z2 on the unit sphere; its integral over a ring of an
/// outline that is ds long is 2 pi ds. Neighbours in the list are neighbours on the burr.
std::vector<BurrPatch> burr_patches(const Burr& burr, double spacing_mm);

}  // namespace osteomill
