// A structure in the patient, such as a nerve: a set of voxels of the bone's grid, whether bone is there or
// not.
//
// It is kept by brick, so it costs memory only for the bricks in which it lies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick.h"

namespace osteomill {

/// The voxels of a structure in one brick.
struct StructureBrick {
    BrickIndex brick = 0;
    VoxelMask voxels{};

    bool operator==(const StructureBrick&) const = default;
};

/// A box of voxels, both ends included.
struct VoxelBounds {
    glm::ivec3 first{0};
    glm::ivec3 last{0};

    bool operator==(const VoxelBounds&) const = default;
};

class StructureMask {
  public:
    StructureMask() = default;
    /// Bricks without voxels are left out. Throws std::invalid_argument for a bad grid, bricks that do not
    /// ascend or lie outside the grid, and voxels past the grid's edge.
    StructureMask(const Grid& grid, std::vector<StructureBrick> bricks);

    const Grid& grid() const { return grid_; }
    /// Ascending by brick; each has voxels.
    const std::vector<StructureBrick>& bricks() const { return bricks_; }
    bool empty() const { return bricks_.empty(); }
    /// False outside the grid.
    bool contains(const glm::ivec3& voxel) const;
    std::uint64_t voxel_count() const;
    double volume_mm3() const { return static_cast<double>(voxel_count()) * voxel_volume_mm3(grid_); }
    /// Smallest box round all voxels; nothing for an empty structure.
    std::optional<VoxelBounds> bounds() const;
    std::size_t memory_bytes() const { return bricks_.capacity() * sizeof(StructureBrick); }

    bool operator==(const StructureMask&) const = default;

  private:
    Grid grid_{};
    std::vector<StructureBrick> bricks_;
};

/// A structure of a scene: where one of its tissues is, on the bone's grid.
struct Structure {
    std::size_t tissue = 0;  ///< index in the scene's tissues
    StructureMask mask{};
};

// The structure made of a tissue's labels in a bone: for structures without a mask of their own.

/// All voxels of the bone's bricks with this label, whatever fraction is left; empty if there are none.
StructureMask structure_in_bone(const Bone& bone, std::uint8_t label);

/// Whether any bone left in the brick of that slot has the label. For one brick at a time: a whole large bone
/// takes long.
bool brick_has_label(const Bone& bone, std::size_t slot, std::uint8_t label);

}  // namespace osteomill
