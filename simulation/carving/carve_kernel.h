// Inner loops of carving one short sweep, brick by brick: they list the voxels that may change with their
// fractions, lower the list eight at a time, then write it back row by row. Rows of the crescent are a few
// voxels long and end unpredictably, so the work for each voxel runs over the list, without a branch.
#pragma once

#include <array>
#include <cstdint>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "simulation/carving/carve.h"
#include "simulation/carving/crescent_rows.h"
#include "simulation/carving/removed_voxels.h"
#include "simulation/carving/voxel_coverage.h"

namespace osteomill {

class CarveKernel {
  public:
    /// `base`: the voxel that positions are counted from, the first of a brick; `sweep` is seen from it.
    /// Changed bricks go to `changes` (null: the bone is left as it is), the voxels' losses to `removed`, the
    /// last of them with hand_on_voxels(); in a fixed order. Real-time safe, and so is all the rest.
    CarveKernel(Bone& bone, const glm::ivec3& base, const SweepSeenFrom& sweep, const CarveSettings& settings,
                ChangeSink* changes, RemovalSink& removed) noexcept;

    /// Lowers the voxels that the sweep covers of the bricks in row `brick_y` of a layer. `z`: the slices of
    /// the layer that there are.
    void carve_bricks(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                      const VoxelRange& z) noexcept;

    /// Hands on the lost voxels that have not been.
    void hand_on_voxels() noexcept;

  private:
    /// The inner loops; in the source, where vectors are at home.
    struct Loops;

    void carve_bricks_plain(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                            const VoxelRange& z) noexcept;
    void carve_bricks_avx2(const CrescentRows& rows, const BrickLayer& layer, int brick_y,
                           const VoxelRange& z) noexcept;
    /// Writes the listed rows' fractions into their brick and reports its change, if any.
    void write_back(std::int32_t slot) noexcept;
    std::uint8_t* left_of_list() { return &left_[brick_edge_voxels]; }

    RemovedVoxels voxels_;  // scratch, not cleared
    Bone& bone_;
    SweepSeenFrom sweep_;
    InstructionSet instructions_;
    const UncutTissues* uncut_;
    ChangeSink* changes_;
    RemovalSink& sink_;
    /// Neighbouring voxels of a row of a brick: offset of the first, and how many, in one number.
    struct Row {
        std::int32_t number;

        template <typename Numbers>
        static Numbers packed(const Numbers& first, const Numbers& length) {
            return first | length << 16;
        }
        std::size_t first() const { return static_cast<std::uint32_t>(number) & 0xffffu; }
        std::size_t length() const { return static_cast<std::uint32_t>(number) >> 16u; }
    };
    /// Rows of a brick: left and right of the ball's inside.
    static constexpr std::size_t most_rows = 2 * std::size_t{brick_edge_voxels} * brick_edge_voxels;
    /// Beyond its end a list is written to, for up to two more rows.
    static constexpr std::size_t list_length = brick_voxel_count + 2 * brick_edge_voxels;

    // Scratch for the brick that is being carved, not cleared: its rows of voxels; then, row after row, the
    // offset of each voxel in them, and its fraction afterwards.
    std::size_t row_count_ = 0;
    std::array<Row, most_rows + RemovedVoxels::lanes> rows_;
    std::array<std::int32_t, list_length> list_;
    std::array<std::uint8_t, brick_edge_voxels + list_length> left_;  // behind space for a row
};

}  // namespace osteomill
