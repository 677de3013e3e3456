#include "haptic_server/streaming/edit_guesser.h"

#include <utility>

#include "haptic_server/streaming/sweep_fit.h"

namespace osteomill {

namespace {

/// Ten times what a fit needs; a frame of a large burr has thousands.
constexpr std::size_t most_fitted_voxels = 2000;

std::vector<PartVoxel> part_voxels(const Bone& bone, const std::vector<ChangedBrick>& bricks) {
    std::size_t changed = 0;
    for (const ChangedBrick& brick : bricks) changed += brick.voxels.count();
    const std::size_t stride = 1 + changed / most_fitted_voxels;
    std::vector<PartVoxel> voxels;
    std::size_t passed = 0;
    for (const ChangedBrick& brick : bricks) {
        const auto fractions = bone.fractions(bone.slot(brick.brick));
        const glm::ivec3 first = brick_edge_voxels * brick_position(bone.content().size_bricks, brick.brick);
        for (std::size_t voxel = brick.voxels._Find_first(); voxel < brick_voxel_count;
             voxel = brick.voxels._Find_next(voxel))
            if (fractions[voxel] > 0 && fractions[voxel] < 255 && ++passed % stride == 0)
                voxels.push_back({glm::dvec3(first + voxel_in_brick(voxel)), fractions[voxel]});
    }
    return voxels;
}

}  // namespace

const EditGuesser::Guessed& EditGuesser::guess(const BoneMirror& mirror, std::vector<ChangedBrick> bricks,
                                               const std::optional<BurrMotion>& motion) {
    const bool is_known = version_ == mirror.version() && motion_ == motion && bricks_ == bricks;
    if (is_known && !bricks.empty()) return guessed_;
    version_ = mirror.version();
    bricks_ = std::move(bricks);
    motion_ = motion;
    std::optional<GuessedSweep> sweep;
    guessed_.burr = motion ? motion->to : glm::dvec3(0.0);
    if (motion) {
        guessed_.burr = fit_end_of_sweep(motion->from, motion->to, motion->radius, motion->smoothing,
                                         part_voxels(mirror.bone(), bricks_));
        sweep = guessed_sweep(motion->from, guessed_.burr, motion->radius, motion->smoothing);
    }
    guessed_.edits = packer_.pack(mirror.bone(), bricks_, sweep);
    return guessed_;
}

}  // namespace osteomill
