// Removal of bone by a burr head other than a ball: a body of revolution, swept along a straight line with
// its spindle held still. Idempotent like carve.h: the fraction left of a voxel depends only on the nearest
// approach of the head's surface.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/burr_profile.h"
#include "simulation/carving/carve.h"
#include "simulation/carving/removed_voxels.h"

namespace osteomill {

/// A head that moves from `from` to `to`, both of the burr's origin, in voxel coordinates.
struct HeadSweep {
    const BurrProfile& profile;  ///< in voxels
    glm::dmat3 frame{1.0};       ///< burr axes in patient axes
    glm::dvec3 from{0.0};
    glm::dvec3 to{0.0};
};

/// Distance of a point from the space that the head sweeps, voxels; negative inside. Within a hundredth of a
/// voxel for sweeps of up to four voxels. Real-time safe.
double distance_from(const HeadSweep& sweep, const glm::dvec3& point) noexcept;

/// Does the same as carve() with settings.coverage and settings.uncut, but each step visits the whole head: a
/// brick and a block of four voxels at a time, by their distance from the surface. Real-time safe.
void carve_head(Bone& bone, const HeadSweep& sweep, const CarveSettings& settings, ChangeSink& changes,
                RemovalSink& removed) noexcept;

/// The preview_carve() of carve.h for a head.
void preview_carve(Bone& bone, const HeadSweep& sweep, const CarveSettings& settings,
                   RemovalSink& would_go) noexcept;

}  // namespace osteomill
