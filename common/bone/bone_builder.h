// Builds a bone brick by brick, so that no dense copy of the grid is ever needed.
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

    /// Adds a brick. Bricks may come in any order, each once; one whose fractions are all zero is not stored.
    /// `stiffness` and `tissue` are read only where the bone has such a channel, and must then not be null.
    /// Throws std::invalid_argument for a brick outside the grid, a second one at the same place, a missing
    /// channel, or a nonzero fraction past the grid's edge.
    void add_brick(const glm::ivec3& brick, const ByteBrick& fraction, const ByteBrick* stiffness,
                   const ByteBrick* tissue);

    /// The finished bone; the builder is spent.
    Bone build() &&;

  private:
    explicit BoneBuilder(const Grid& grid);
    BoneContent content_;
    bool heterogeneous_ = false;
    bool labelled_ = false;
    std::vector<ByteBrick> fraction_;
};

}  // namespace osteomill
