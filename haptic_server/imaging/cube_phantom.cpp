#include <algorithm>

#include "haptic_server/imaging/phantom.h"

namespace osteomill {

HuVolume make_cube_phantom() {
    // A layer of air above the bone, so that its top is a surface; voxel centres at z = ..., -0.05 (bone),
    // 0.05 (air).
    const Grid grid{.size_voxels = {500, 500, 121}, .spacing_mm = 0.1, .origin_mm = {-24.95, -24.95, -11.95}};
    const std::size_t slice = 500 * 500;
    HuVolume volume{.grid = grid, .hu = std::vector<std::int16_t>(slice * 121, air_hu), .tissue = {}};
    std::fill_n(volume.hu.begin(), slice * 120, static_cast<std::int16_t>(reference_bone_hu));
    return volume;
}

}  // namespace osteomill
