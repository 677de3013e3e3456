// A ball swept through a bone by the program's own carve, outside of a session.
#pragma once

#include <vector>

#include "common/bone/brick_change.h"
#include "simulation/carving/carve.h"

namespace osteomill::study {

/// Removes the bone in the way of a ball from one place to another, patient LPS, mm. Returns the changes,
/// ascending.
inline std::vector<BrickChange> swept_changes(Bone& bone, const glm::dvec3& from_mm, const glm::dvec3& to_mm,
                                              double radius_mm) {
    class Gatherer final : public ChangeSink {
      public:
        void push(const BrickChange& change, BrickFractions) noexcept override { changes.add(change); }
        GatheredChanges changes;
    };
    class Nobody final : public RemovalSink {
      public:
        void take(const RemovedVoxels&) noexcept override {}
    };
    Gatherer gatherer;
    Nobody nobody;
    const Grid& grid = bone.grid();
    carve(
        bone,
        {to_voxel_coordinates(grid, from_mm), to_voxel_coordinates(grid, to_mm), radius_mm / grid.spacing_mm},
        CarveHistory::none, {}, gatherer, nobody);
    return gatherer.changes.take();
}

}  // namespace osteomill::study
