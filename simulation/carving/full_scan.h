// The published way to find the bone that a burr removes: the burr is a set of voxels, and every step takes
// every one of them, some 65 000 for a 5 mm burr at 0.1 mm, turns it into the burr's frame, tests it against
// the burr's shape and the bone, and lowers its fraction. No empty brick is passed over, and no crescent is
// known. The fraction that a sweep leaves in a voxel follows the same rule as in carve.h, so the bone is the
// same; only the search for its voxels differs. The speed of carve() is compared with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "simulation/carving/carve.h"

namespace osteomill {

class FullScan {
  public:
    /// A burr of so many voxels' radius, above 0. Sixteen bytes for each of its voxels.
    FullScan(double radius_voxels, VoxelCoverage coverage);

    /// Does the same as carve() without a history, with this burr's radius and coverage: in a fixed order,
    /// each changed brick once a step of CrescentRows::longest_step_voxels. `burr_frame`: burr axes in
    /// patient axes. Real-time safe.
    void carve(Bone& bone, const Sweep& ball, const glm::dmat3& burr_frame, const CarveSettings& settings,
               ChangeSink& changes, RemovalSink& removed) noexcept;

    /// Those that a scan visits while the burr stands still.
    std::size_t voxel_count() const;

  private:
    /// A voxel of the burr, counted from the one nearest to its centre.
    struct BurrVoxel {
        glm::ivec3 offset;
        float distance_voxels;
    };

    void carve_short(Bone& bone, const Sweep& ball, const glm::dmat3& burr_frame,
                     const CarveSettings& settings, ChangeSink& changes, RemovalSink& removed) noexcept;
    /// Lowers the voxels of `met_`, and hands on those that lose something.
    void lower(Bone& bone, const SweepSeenFrom& sweep, const CarveSettings& settings,
               RemovalSink& removed) noexcept;
    void mark_changed(const BoneContent& content, std::int32_t slot, std::size_t offset) noexcept;

    double radius_;
    VoxelCoverage coverage_;
    std::vector<BurrVoxel> voxels_;  // nearest first, as far as a step's middle can be from its ends
    // Scratch of a step: bone within the burr, a batch at a time, and the bricks that it changed, in a cube
    // of `bricks_across_` about the burr.
    RemovedVoxels met_;
    int bricks_across_;
    glm::ivec3 first_brick_{0};
    std::vector<std::int32_t> change_of_brick_;
    std::vector<BrickChange> changes_;
};

}  // namespace osteomill
