#include "imaging/bone_file/ct_overview.h"

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <vector>

namespace osteomill {

namespace {

std::size_t count_of(const glm::ivec3& size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
}

int coarsening_of(const Grid& grid, std::size_t most_voxels) {
    int coarsening = 1;
    while (count_of((grid.size_voxels + (coarsening - 1)) / coarsening) > most_voxels) ++coarsening;
    return coarsening;
}

}  // namespace

CtVolume ct_overview(const HuSlices& slices, std::size_t most_voxels) {
    const Grid& fine = slices.grid;
    const int by = coarsening_of(fine, most_voxels);
    CtVolume ct{.grid = {.size_voxels = (fine.size_voxels + (by - 1)) / by,
                         .spacing_mm = by * fine.spacing_mm,
                         .origin_mm = fine.origin_mm + 0.5 * (by - 1) * fine.spacing_mm},
                .hu = {}};
    const glm::ivec3 size = ct.grid.size_voxels;
    ct.hu.resize(count_of(size));
    const auto slice_size = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    const auto fine_slice_size =
        static_cast<std::size_t>(fine.size_voxels.x) * static_cast<std::size_t>(fine.size_voxels.y);
    std::vector<std::int16_t> hu(fine_slice_size);
    std::vector<std::uint8_t> tissue(slices.labelled ? fine_slice_size : 0);
    std::vector<std::int32_t> sum(slice_size), count(slice_size);
    for (int z = 0; z < fine.size_voxels.z; ++z) {
        slices.read(hu, tissue);
        for (int y = 0; y < fine.size_voxels.y; ++y)
            for (int x = 0; x < fine.size_voxels.x; ++x) {
                const auto to = static_cast<std::size_t>(x / by) +
                                static_cast<std::size_t>(size.x) * static_cast<std::size_t>(y / by);
                sum[to] += hu[static_cast<std::size_t>(x) +
                              static_cast<std::size_t>(fine.size_voxels.x) * static_cast<std::size_t>(y)];
                ++count[to];
            }
        if ((z + 1) % by != 0 && z + 1 != fine.size_voxels.z) continue;
        const std::size_t first = slice_size * static_cast<std::size_t>(z / by);
        for (std::size_t i = 0; i < slice_size; ++i) {
            ct.hu[first + i] = static_cast<std::int16_t>(std::lround(static_cast<double>(sum[i]) / count[i]));
            sum[i] = count[i] = 0;
        }
    }
    return ct;
}

}  // namespace osteomill
