// Lowers the voxels of a short sweep, brick by brick: lists those that may change, then does the list eight
// at a time. Rows of the crescent are a few voxels long and nobody can predict where they end, so what is
// done for each voxel runs over the list, without a branch.
#pragma once

#include <array>
#include <cstdint>

#include "common/bone/bone.h"
#include "common/bone/edit.h"
#include "haptic_server/milling/brick_layer.h"
#include "haptic_server/milling/cover.h"
#include "haptic_server/milling/crescent_rows.h"
#include "haptic_server/milling/removed_voxels.h"

namespace osteomill {

class Lowering {
  public:
    /// `base`: the voxel that places are counted from, the first of a brick; `sweep` is seen from it. What
    /// voxels lose goes to `removed`, rows of bricks that changed to `edits`, in a fixed order, at the latest
    /// with flush(). Real-time safe, and so is all the rest.
    Lowering(Bone& bone, const glm::ivec3& base, const SweepSeenFrom& sweep, InstructionSet instructions,
             EditSink& edits, RemovalSink& removed) noexcept;

    /// Lowers what the sweep covers of the bricks in row `brick_y` of a layer. `z`: the slices of the layer
    /// that there are.
    void lower_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                      const VoxelRange& z) noexcept;

    /// Hands on what has not been.
    void flush() noexcept;

  private:
    /// The inner loops; in the source, where vectors are at home.
    struct Kernel;

    void lower_bricks_plain(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                            const VoxelRange& z) noexcept;
    void lower_bricks_avx2(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                           const VoxelRange& z) noexcept;
    void report_changes() noexcept;
    void report_row(std::size_t row) noexcept;
    void hand_on_voxels() noexcept;

    Bone& bone_;
    SweepSeenFrom sweep_;
    InstructionSet instructions_;
    EditSink& edits_;
    RemovalSink& sink_;
    // The brick that was last lowered and not yet reported, and its rows: bit i is set where voxel i changed.
    std::int32_t changed_slot_ = BoneContent::no_slot;
    alignas(64) std::array<std::uint16_t, std::size_t{brick_edge_voxels} * brick_edge_voxels> changed_{};
    // Scratch, not cleared: a step starts with nothing to do.
    alignas(
        64) std::array<std::int32_t, brick_voxel_count + 2 * RemovedVoxels::lanes> list_;  // offsets in it
    RemovedVoxels voxels_;
};

}  // namespace osteomill
