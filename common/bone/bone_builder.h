// Builder of a bone, brick by brick, so that no dense copy of the grid is ever needed, and building takes no
// more memory than the finished bone: bricks are kept in pieces, which never move while they grow in number,
// and are freed one by one as the bone is put together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "common/bone/bone.h"

namespace osteomill {

/// Bricks of one channel in the order in which they were added.
class BrickPieces {
  public:
    /// Reserves so many bricks in one piece, which then becomes the channel itself.
    void reserve(std::size_t count);
    void push_back(const ByteBrick& brick);
    /// All of them, in one; nothing stays behind.
    std::vector<ByteBrick> take();

    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (const std::vector<ByteBrick>& piece : pieces_)
            for (const ByteBrick& brick : piece) visit(brick);
    }

  private:
    std::vector<std::vector<ByteBrick>> pieces_;
};

class BoneBuilder {
  public:
    /// A homogeneous bone of the given relative stiffness. Throws std::invalid_argument for a bad grid or
    /// stiffness.
    static BoneBuilder homogeneous(const Grid& grid, double relative_stiffness, bool labelled);
    /// A bone with a stiffness code for each voxel: relative stiffness = code * stiffness_per_code.
    static BoneBuilder heterogeneous(const Grid& grid, double stiffness_per_code, bool labelled);

    /// Reserves so many bricks in all. An upper bound will do: unused places cost addresses, not memory.
    /// Throws std::bad_alloc if even addresses are short.
    void reserve_bricks(std::size_t count);

    /// Adds a brick. Bricks may come in any order, each once; in ascending order build() need not sort them.
    /// One whose fractions are all zero is not stored. `stiffness` and `tissue` are read only if the bone has
    /// such a channel, and must then not be null. Throws std::invalid_argument for a brick outside the grid,
    /// a missing channel, or a nonzero fraction past the grid's edge.
    void add_brick(const glm::ivec3& brick, const ByteBrick& fraction, const ByteBrick* stiffness,
                   const ByteBrick* tissue);

    /// From now on each voxel has a code of its own; all bone so far had `code`. The homogeneous builder's
    /// relative stiffness must have been code * stiffness_per_code. Throws std::invalid_argument for a bad
    /// stiffness per code, std::logic_error if the bone is heterogeneous already.
    void make_heterogeneous(double stiffness_per_code, std::uint8_t code);

    /// The finished bone; the builder is spent. Throws std::invalid_argument for a brick that came twice.
    Bone build() &&;

  private:
    explicit BoneBuilder(const Grid& grid);
    BoneContent content_;
    bool heterogeneous_ = false;
    bool labelled_ = false;
    BrickPieces fraction_;
    BrickPieces stiffness_;
    BrickPieces tissue_;
};

/// Values of one voxel; stiffness and tissue count if the bone has such a channel.
struct VoxelValues {
    std::uint8_t fraction = 0;
    std::uint8_t stiffness = 0;  ///< its code
    std::uint8_t tissue = 0;
};

/// The bone whose voxels have the values `values_of(voxel)`, a VoxelValues, all over the builder's grid.
template <typename ValuesOf>
Bone filled(BoneBuilder builder, const Grid& grid, ValuesOf&& values_of) {
    const glm::ivec3 size = size_in_bricks(grid);
    for (BrickIndex index = 0; index < static_cast<BrickIndex>(size.x * size.y * size.z); ++index) {
        const glm::ivec3 brick = brick_position(size, index);
        ByteBrick fraction{}, stiffness{}, tissue{};
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::ivec3 voxel = brick_edge_voxels * brick + voxel_in_brick(offset);
            if (!contains(grid, voxel)) continue;
            const VoxelValues values = values_of(voxel);
            fraction[offset] = values.fraction;
            stiffness[offset] = values.stiffness;
            tissue[offset] = values.tissue;
        }
        builder.add_brick(brick, fraction, &stiffness, &tissue);
    }
    return std::move(builder).build();
}

}  // namespace osteomill
