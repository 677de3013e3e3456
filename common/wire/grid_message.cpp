#include "common/wire/grid_message.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "common/wire/vec3.h"

namespace osteomill {

v2::Grid to_message(const Grid& grid) {
    v2::Grid message;
    message.set_size_x(static_cast<std::uint32_t>(grid.size_voxels.x));
    message.set_size_y(static_cast<std::uint32_t>(grid.size_voxels.y));
    message.set_size_z(static_cast<std::uint32_t>(grid.size_voxels.z));
    message.set_spacing_mm(grid.spacing_mm);
    write(grid.origin_mm, *message.mutable_origin_mm());
    return message;
}

std::variant<Grid, WireError> grid_from(const v2::Grid& message) {
    constexpr auto largest = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
    if (std::max({message.size_x(), message.size_y(), message.size_z()}) > largest)
        return WireError{"the grid has more than 65536 voxels along an axis"};
    const Grid grid{.size_voxels = {static_cast<int>(message.size_x()), static_cast<int>(message.size_y()),
                                    static_cast<int>(message.size_z())},
                    .spacing_mm = message.spacing_mm(),
                    .origin_mm = read(message.origin_mm())};
    try {
        require_valid(grid);
    } catch (const std::invalid_argument& error) {
        return WireError{error.what()};
    }
    return grid;
}

}  // namespace osteomill
