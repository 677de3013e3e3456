#include <algorithm>
#include <span>

#include "imaging/phantoms/phantom.h"

namespace osteomill {

HuSlices make_cube_phantom() {
    // A layer of air above the bone, so that its top is a surface; voxel centres at z = ..., -0.05 (bone),
    // 0.05 (air).
    const Grid grid{.size_voxels = {500, 500, 121}, .spacing_mm = 0.1, .origin_mm = {-24.95, -24.95, -11.95}};
    constexpr std::size_t bone_voxels = 500 * 500 * 120;
    return {.grid = grid,
            .labelled = false,
            .read = [=, at = std::size_t{0}](std::span<std::int16_t> hu, std::span<std::uint8_t>) mutable {
                const std::size_t bone = std::min(hu.size(), bone_voxels - std::min(at, bone_voxels));
                std::fill_n(hu.begin(), bone, static_cast<std::int16_t>(reference_bone_hu));
                std::fill(hu.begin() + static_cast<std::ptrdiff_t>(bone), hu.end(), air_hu);
                at += hu.size();
            }};
}

}  // namespace osteomill
