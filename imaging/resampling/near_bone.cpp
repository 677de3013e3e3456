#include "imaging/resampling/near_bone.h"

#include <algorithm>

#include "imaging/bone_from_hu.h"

namespace osteomill {

namespace {
constexpr int reach = kept_voxels_around_bone;
}

NearBone::NearBone(const Grid& grid, double threshold_hu, int held_slices)
    : grid_(grid), threshold_hu_(threshold_hu), masks_(static_cast<std::size_t>(held_slices)) {
    for (Mask& mask : masks_)
        mask.resize(static_cast<std::size_t>(grid.size_voxels.x) *
                    static_cast<std::size_t>(grid.size_voxels.y));
}

void NearBone::look_at(int z, std::span<const std::int16_t> hu) {
    const auto nx = static_cast<std::size_t>(grid_.size_voxels.x);
    const auto ny = static_cast<std::size_t>(grid_.size_voxels.y);
    Mask& widened = masks_[static_cast<std::size_t>(z) % masks_.size()];
    std::fill(widened.begin(), widened.end(), std::uint8_t{0});
    std::uint64_t bone = 0;
    Mask along_x(nx);
    for (std::size_t y = 0; y < ny; ++y) {
        const std::uint64_t bone_before = bone;
        std::fill(along_x.begin(), along_x.end(), std::uint8_t{0});
        for (std::size_t x = 0; x < nx; ++x) {
            if (hu[y * nx + x] < threshold_hu_) continue;
            ++bone;
            const std::size_t first = x < reach ? 0 : x - reach;
            const std::size_t last = std::min(nx - 1, x + reach);
            std::fill_n(along_x.begin() + static_cast<std::ptrdiff_t>(first), last - first + 1, 1);
        }
        if (bone == bone_before) continue;
        for (std::size_t to = y < reach ? 0 : y - reach; to <= std::min(ny - 1, y + reach); ++to)
            for (std::size_t x = 0; x < nx; ++x) widened[to * nx + x] |= along_x[x];
    }
    bone_voxels_ += bone;
}

void NearBone::clear_far(int z, std::span<std::int16_t> hu) const {
    Mask keep(hu.size());
    for (int near = std::max(0, z - reach); near <= std::min(grid_.size_voxels.z - 1, z + reach); ++near)
        for (std::size_t i = 0; i < hu.size(); ++i) keep[i] |= mask(near)[i];
    for (std::size_t i = 0; i < hu.size(); ++i) hu[i] = keep[i] == 0 ? air_hu : hu[i];
}

}  // namespace osteomill
