// The region of a plan: which voxels of a bone are in it, and how far others are from it.
#pragma once

#include "analysis/report/voxel_set.h"
#include "common/bone/bone.h"
#include "common/scene/plan.h"
#include "common/wire/session_info.h"

namespace osteomill {

class PlannedRegion {
  public:
    /// The region in the bone as it was. `bone` and `session` outlive it; the session has a plan.
    PlannedRegion(const Bone& bone, const SessionInfo& session);

    const VoxelSet& voxels() const { return voxels_; }
    /// Whether the region holds a voxel, be it bone or not.
    bool holds(std::int32_t slot, std::size_t offset, const glm::ivec3& voxel) const;
    /// A tissue, and so a set of voxels; else a body with a border of its own.
    bool is_tissue() const { return std::holds_alternative<TissueRegion>(plan_.region); }
    /// Whether the tissue's bone is in a voxel, be it of the grid or beyond.
    bool has_tissue(const glm::ivec3& voxel) const;
    /// Whether the region holds a place in patient LPS, in a tissue also between the centres of voxels.
    bool holds(const glm::dvec3& place_mm) const;
    /// From a place outside of it: to the sphere or cylinder, or to the centre of the tissue's nearest voxel.
    /// Infinite if the bone has none of the tissue.
    double distance_mm(const glm::dvec3& place_mm) const;

  private:
    const Bone& bone_;
    const Plan& plan_;
    int label_ = -1;  // of the tissue; -1: none
    VoxelSet voxels_;
    NearestPlace surface_;
};

}  // namespace osteomill
