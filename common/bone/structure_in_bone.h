// The structure made of a tissue's labels in a bone: for structures without a mask of their own.
#pragma once

#include <cstdint>

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"

namespace osteomill {

/// All voxels of the bone's bricks with this label, whatever fraction is left; empty if there are none.
StructureMask structure_in_bone(const Bone& bone, std::uint8_t label);

/// Whether any bone left in the brick of that slot has the label. For one brick at a time: a whole large bone
/// takes long.
bool brick_has_label(const Bone& bone, std::size_t slot, std::uint8_t label);

}  // namespace osteomill
