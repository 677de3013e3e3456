// A grid in and out of its message.
#pragma once

#include <variant>

#include "common/bone/grid.h"
#include "common/wire/wire_error.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill {

v2::Grid to_message(const Grid& grid);

/// Refuses the same grids as require_valid().
std::variant<Grid, WireError> grid_from(const v2::Grid& message);

}  // namespace osteomill
