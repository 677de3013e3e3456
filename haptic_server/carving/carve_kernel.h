// Inner loops of carving one short sweep, brick by brick: they list the voxels that may change, then do the
// list eight at a time. Rows of the crescent are a few voxels long and nobody can predict where they end, so
// what is done for each voxel runs over the list, without a branch.
#pragma once

#include <array>
#include <cstdint>

#include "common/bone/bone.h"
#include "common/bone/edit.h"
#include "haptic_server/carving/brick_layer.h"
#include "haptic_server/carving/crescent_rows.h"
#include "haptic_server/carving/removed_voxels.h"
#include "haptic_server/carving/voxel_coverage.h"

namespace osteomill {

class CarveKernel {
  public:
    /// `base`: the voxel that positions are counted from, the first of a brick; `sweep` is seen from it. What
    /// voxels lose goes to `removed`, rows of bricks that changed to `edits`, in a fixed order, at the latest
    /// with flush(). Real-time safe, and so is all the rest.
    CarveKernel(Bone& bone, const glm::ivec3& base, const SweepSeenFrom& sweep, InstructionSet instructions,
                EditSink& edits, RemovalSink& removed) noexcept;

    /// Lowers what the sweep covers of the bricks in row `brick_y` of a layer. `z`: the slices of the layer
    /// that there are.
    void carve_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                      const VoxelRange& z) noexcept;

    /// Hands on what has not been.
    void flush() noexcept;

  private:
    /// The inner loops; in the source, where vectors are at home.
    struct Loops;

    void carve_bricks_plain(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                            const VoxelRange& z) noexcept;
    void carve_bricks_avx2(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                           const VoxelRange& z) noexcept;
    void report_changes() noexcept;
    void report_run(std::size_t first_voxel, std::size_t last_voxel) noexcept;
    void hand_on_voxels() noexcept;

    Bone& bone_;
    SweepSeenFrom sweep_;
    InstructionSet instructions_;
    EditSink& edits_;
    RemovalSink& sink_;
    /// Neighbouring voxels of a row of a brick, and where in the list they begin.
    struct Row {
        std::uint16_t first;  ///< offset in the brick
        std::uint16_t length;
        std::uint16_t list_start;
    };
    /// Rows of a brick: left and right of the ball's inside.
    static constexpr std::size_t most_rows = 2 * std::size_t{brick_edge_voxels} * brick_edge_voxels;

    // Scratch, not cleared: a step starts with nothing to do. The rows of the brick that is being listed, and
    // of the one that was last lowered and is not yet reported; of its list, bit i of the stream is set where
    // voxel i lost something.
    std::int32_t changed_slot_ = BoneContent::no_slot;
    std::size_t row_count_ = 0;
    std::size_t changed_row_count_ = 0;
    std::array<Row, most_rows + RemovedVoxels::lanes> rows_;
    std::array<Row, most_rows + RemovedVoxels::lanes> changed_rows_;
    std::array<std::uint8_t, brick_voxel_count / 8 + 2> changed_;
    alignas(
        64) std::array<std::int32_t, brick_voxel_count + 2 * RemovedVoxels::lanes> list_;  // offsets in it
    RemovedVoxels voxels_;
};

}  // namespace osteomill
