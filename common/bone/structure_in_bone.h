// The structure that has a tissue's label in a bone: where nothing else says where it is.
#pragma once

#include <cstdint>

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"

namespace osteomill {

/// The voxels of the bone's bricks that bear the label, whatever is left of them; empty where none does.
StructureMask structure_in_bone(const Bone& bone, std::uint8_t label);

/// Whether any bone that is left in the brick of that slot has the label. Brick by brick: a large bone takes
/// long.
bool brick_has_label(const Bone& bone, std::size_t slot, std::uint8_t label);

}  // namespace osteomill
