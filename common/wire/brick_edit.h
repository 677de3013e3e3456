// What milling changed in one brick, in and out of a message.
#pragma once

#include <optional>
#include <variant>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/wire/wire_error.h"
#include "osteomill/v1/bone.pb.h"

namespace osteomill {

/// The fractions of the changed voxels, as runs that hold these voxels and no others.
v1::BrickEdit brick_edit(const BrickChange& change, BrickFractions fractions);

/// Writes an edit into the bone. Refused, with the bone as it was: a brick that is not stored, runs that do
/// not ascend or reach past the brick, fractions that do not fit the runs, and any that would raise what is
/// left.
std::optional<WireError> apply_brick_edit(const v1::BrickEdit& edit, Bone& bone);

/// Whether an edit that was written could have come of milling.
enum class EditEffect { lowers, raises };

/// Likewise for a copy that may be wrong: what would raise a voxel is written, too, and said; but bone
/// outside the grid is refused.
std::variant<EditEffect, WireError> correct_with_brick_edit(const v1::BrickEdit& edit, Bone& bone);

}  // namespace osteomill
