// A grid in and out of its message.
#pragma once

#include <variant>

#include "common/bone/grid.h"
#include "common/wire/wire_error.h"
#include "osteomill/v1/bone.pb.h"

namespace osteomill {

v1::Grid to_message(const Grid& grid);

/// Refuses what require_valid() does.
std::variant<Grid, WireError> grid_from(const v1::Grid& message);

}  // namespace osteomill
