// A burr pressed into a block whose top face is z = 0, and the result of a contact law.
#pragma once

#include "simulation/force_models/contact_law.h"
#include "tests/support/block.h"

namespace osteomill::testing {

inline Burr five_mm() {
    return {.name = "5 mm", .diameter_mm = 5.0};
}

/// 5 mm wide, 2 mm deep, top face at z = 0: room for a 5 mm burr 1 mm deep.
inline Bone wide_block(double spacing_mm = 0.1) {
    return make_block({-2.6, -2.6, -2.2}, {2.6, 2.6, 0.0}, spacing_mm);
}

/// Lowers the fraction of every voxel for which `is_gone(centre, mm)` to zero.
template <typename IsGone>
void remove_where(Bone& bone, IsGone&& is_gone) {
    const glm::ivec3 size = bone.grid().size_voxels;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::ivec3 voxel(x, y, z);
                if (!is_gone(centre_of_voxel_mm(bone.grid(), voxel))) continue;
                const std::int32_t slot = bone.slot(voxel >> 4);
                if (slot != BoneContent::no_slot) bone.fractions(slot)[offset_in_brick(voxel)] = 0;
            }
}

class ContactBench {
  public:
    explicit ContactBench(Bone bone, const Burr& burr = five_mm())
        : bone_(std::move(bone)),
          burr_(burr),
          bricks_(burr.radius_mm() / bone_.grid().spacing_mm + BurrContact::margin_voxels) {}

    ContactReaction at(ContactLaw& law, const glm::dvec3& position_mm, bool spindle_on = false,
                       const glm::dvec3& spindle_axis = {0.0, 0.0, 1.0}) {
        const glm::dvec3 centre = to_voxel_coordinates(bone_.grid(), position_mm);
        const double radius = burr_.radius_mm() / bone_.grid().spacing_mm;
        if (!bricks_.gather(bone_, centre, radius + BurrContact::margin_voxels)) return {};
        return law.react({.bone = bone_,
                          .bricks = bricks_,
                          .burr = burr_,
                          .centre_voxels = centre,
                          .radius_voxels = radius,
                          .spindle_axis = spindle_axis,
                          .spindle_on = spindle_on});
    }

    /// Pressed straight down, off the lattice as a hand is; the lowest point `depth_mm` below the top face.
    ContactReaction pressed(ContactLaw& law, double depth_mm, bool spindle_on = false) {
        return at(law, {0.031, 0.017, burr_.radius_mm() - depth_mm}, spindle_on);
    }

  private:
    Bone bone_;
    Burr burr_;
    BrickNeighbourhood bricks_;
};

}  // namespace osteomill::testing
