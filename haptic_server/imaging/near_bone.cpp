#include "haptic_server/imaging/near_bone.h"

#include <algorithm>
#include <array>

namespace osteomill {

namespace {

constexpr int reach = kept_voxels_around_bone;

using Mask = std::vector<std::uint8_t>;

/// Bone of a slice, widened within it.
Mask widened_slice(const HuVolume& volume, int z, double threshold_hu, std::uint64_t& bone) {
    const auto nx = static_cast<std::size_t>(volume.grid.size_voxels.x);
    const auto ny = static_cast<std::size_t>(volume.grid.size_voxels.y);
    const std::int16_t* hu = volume.hu.data() + static_cast<std::size_t>(z) * nx * ny;
    Mask along_x(nx * ny);
    for (std::size_t y = 0; y < ny; ++y)
        for (std::size_t x = 0; x < nx; ++x) {
            if (hu[y * nx + x] < threshold_hu) continue;
            ++bone;
            const std::size_t first = x < reach ? 0 : x - reach;
            const std::size_t last = std::min(nx - 1, x + reach);
            std::fill_n(along_x.begin() + static_cast<std::ptrdiff_t>(y * nx + first), last - first + 1, 1);
        }
    Mask widened(nx * ny);
    for (std::size_t y = 0; y < ny; ++y)
        for (std::size_t from = y < reach ? 0 : y - reach; from <= std::min(ny - 1, y + reach); ++from)
            for (std::size_t x = 0; x < nx; ++x) widened[y * nx + x] |= along_x[from * nx + x];
    return widened;
}

}  // namespace

std::uint64_t clear_far_from_bone(HuVolume& volume, double threshold_hu) {
    const int slices = volume.grid.size_voxels.z;
    const std::size_t length = static_cast<std::size_t>(volume.grid.size_voxels.x) *
                               static_cast<std::size_t>(volume.grid.size_voxels.y);
    std::uint64_t bone = 0;
    // Masks of the slices around the one that is cleared; each is made before its slice is touched.
    std::array<Mask, 2 * reach + 1> ring;
    const auto mask = [&](int z) -> Mask& { return ring[static_cast<std::size_t>(z) % ring.size()]; };
    for (int z = 0; z < std::min(reach, slices); ++z) mask(z) = widened_slice(volume, z, threshold_hu, bone);
    for (int z = 0; z < slices; ++z) {
        if (z + reach < slices) mask(z + reach) = widened_slice(volume, z + reach, threshold_hu, bone);
        std::int16_t* hu = volume.hu.data() + static_cast<std::size_t>(z) * length;
        Mask keep(length);
        for (int near = std::max(0, z - reach); near <= std::min(slices - 1, z + reach); ++near)
            for (std::size_t i = 0; i < length; ++i) keep[i] |= mask(near)[i];
        for (std::size_t i = 0; i < length; ++i)
            if (keep[i] == 0) hu[i] = air_hu;
    }
    return bone;
}

}  // namespace osteomill
