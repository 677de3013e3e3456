// Builds a bone brick by brick, so that no dense copy of the grid is ever needed. With room reserved, what is
// built costs no more memory on the way than the bone that comes out.
#pragma once

#include "common/bone/bone.h"

namespace osteomill {

class BoneBuilder {
  public:
    /// A homogeneous bone of the given relative stiffness. Throws std::invalid_argument for a bad grid or
    /// stiffness.
    static BoneBuilder homogeneous(const Grid& grid, double relative_stiffness, bool labelled);
    /// A bone with a stiffness code for each voxel: relative stiffness = code * stiffness_per_code.
    static BoneBuilder heterogeneous(const Grid& grid, double stiffness_per_code, bool labelled);

    /// Makes room for that many bricks in all, so that none has to move when more come. An upper bound will
    /// do: room that stays unused costs addresses, not memory. Throws std::bad_alloc where even those are
    /// short.
    void reserve_bricks(std::size_t count);

    /// Adds a brick. Bricks may come in any order, each once; in ascending order build() need not sort them.
    /// One whose fractions are all zero is not stored. `stiffness` and `tissue` are read only where the bone
    /// has such a channel, and must then not be null. Throws std::invalid_argument for a brick outside the
    /// grid, a missing channel, or a nonzero fraction past the grid's edge.
    void add_brick(const glm::ivec3& brick, const ByteBrick& fraction, const ByteBrick* stiffness,
                   const ByteBrick* tissue);

    /// The finished bone; the builder is spent. Throws std::invalid_argument for a brick that came twice.
    Bone build() &&;

  private:
    explicit BoneBuilder(const Grid& grid);
    BoneContent content_;
    bool heterogeneous_ = false;
    bool labelled_ = false;
    std::vector<ByteBrick> fraction_;
};

}  // namespace osteomill
