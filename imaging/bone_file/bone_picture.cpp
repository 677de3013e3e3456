#include "imaging/bone_file/bone_picture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "imaging/bone_file/nrrd_form.h"
#include "imaging/bone_from_hu.h"

namespace osteomill {

namespace {

constexpr std::uint64_t most_voxels_of_picture = std::uint64_t{1} << 25;

Grid coarser(const Grid& grid, int times) {
    Grid coarse = grid;
    coarse.size_voxels = (grid.size_voxels + times - 1) / times;
    coarse.spacing_mm = grid.spacing_mm * times;
    coarse.origin_mm = grid.origin_mm + 0.5 * (times - 1) * grid.spacing_mm;
    return coarse;
}

/// Edge of the picture's voxels in voxels of the bone: a power of two, so that none lies in two bricks.
int times_as_long(const Grid& bone) {
    int times = 1;
    while (times < brick_edge_voxels && voxel_count(coarser(bone, times)) > most_voxels_of_picture)
        times *= 2;
    return times;
}

/// The bone left in a brick, summed over the picture's voxels in it, x fastest.
struct BrickSums {
    std::array<std::uint32_t, brick_voxel_count> left{};

    BrickSums(BrickFractions fractions, int times) {
        const int halvings = std::countr_zero(static_cast<unsigned>(times));
        const int edge = brick_edge_voxels >> halvings;
        // Most bricks are whole.
        if (std::memcmp(fractions.data(), fractions.data() + 1, fractions.size() - 1) == 0) {
            left.fill(static_cast<std::uint32_t>(fractions[0]) << 3 * halvings);
            return;
        }
        std::size_t offset = 0;
        for (int z = 0; z < brick_edge_voxels; ++z)
            for (int y = 0; y < brick_edge_voxels; ++y) {
                const std::span row(
                    &left[static_cast<std::size_t>(edge * ((y >> halvings) + edge * (z >> halvings)))],
                    static_cast<std::size_t>(edge));
                for (std::size_t x = 0; x < brick_edge_voxels; ++x) row[x >> halvings] += fractions[offset++];
            }
    }
};

}  // namespace

Grid picture_grid(const Grid& bone) {
    return coarser(bone, times_as_long(bone));
}

HuSlices picture_of(const Bone& bone) {
    const int times = times_as_long(bone.grid());
    const Grid grid = coarser(bone.grid(), times);
    const auto read = [&bone, grid, times, z = 0](std::span<std::int16_t> hu,
                                                  std::span<std::uint8_t>) mutable {
        const auto slice = static_cast<std::size_t>(voxels_of_slice(grid));
        const int end = z + static_cast<int>(hu.size() / slice);
        const int edge = brick_edge_voxels / times;
        const auto whole =
            static_cast<std::uint64_t>(255) * static_cast<std::uint64_t>(times * times * times);
        constexpr auto span_hu = static_cast<std::uint64_t>(reference_bone_hu - air_hu);
        std::fill(hu.begin(), hu.end(), air_hu);
        const BoneContent& content = bone.content();
        for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
            const glm::ivec3 corner = brick_position(content.size_bricks, content.brick_of_slot[slot]) * edge;
            if (corner.z >= end || corner.z + edge <= z) continue;
            const BrickSums sums(bone.fractions(static_cast<std::int32_t>(slot)), times);
            std::size_t i = 0;
            for (int dz = 0; dz < edge; ++dz)
                for (int dy = 0; dy < edge; ++dy)
                    for (int dx = 0; dx < edge; ++dx, ++i) {
                        const glm::ivec3 voxel = corner + glm::ivec3(dx, dy, dz);
                        if (sums.left[i] == 0 || voxel.z < z || voxel.z >= end) continue;
                        hu[static_cast<std::size_t>(voxel.x) +
                           static_cast<std::size_t>(grid.size_voxels.x) * static_cast<std::size_t>(voxel.y) +
                           slice * static_cast<std::size_t>(voxel.z - z)] =
                            static_cast<std::int16_t>(air_hu +
                                                      static_cast<int>(span_hu * sums.left[i] / whole));
                    }
        }
        z = end;
    };
    return {.grid = grid, .labelled = false, .read = read};
}

}  // namespace osteomill
