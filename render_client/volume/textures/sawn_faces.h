// Sawn faces of a piece of bone: where it ends in a plane along the lattice, because a scan's region ends
// there or a made piece is sawn off. Such a face is no anatomy.
//
// The outermost layer of bone on each of the six sides is looked at: it is a sawn face if nearly all of the
// bone that is there three voxels deeper reaches into it. A rounded surface keeps less than half, whatever
// its radius.
#pragma once

#include <glm/vec3.hpp>

#include "common/bone/bone.h"

namespace osteomill {

/// Voxels of the bone's grid; voxel i spans i to i + 1. A side without a sawn face lies `none` away.
struct SawnFaces {
    static constexpr double none = 1e6;
    glm::dvec3 low{-none};
    glm::dvec3 high{none};

    bool any() const;
};

/// Finds the faces of the bone in its present state: bone that was milled off a face does not count. A bone
/// without a voxel that is at least half full has no face.
SawnFaces sawn_faces(const Bone& bone);
/// The two faces across one axis, 0 to 2, into `faces`: a part of that work.
void find_sawn_faces(const Bone& bone, int axis, SawnFaces& faces);

}  // namespace osteomill
