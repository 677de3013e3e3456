// Lowers fractions here and there, as milling would report it.
#pragma once

#include <random>

#include "common/bone/brick_change.h"

namespace osteomill::testing {

/// Carves one run at a random place of the bone and reports it.
inline void carve_somewhere(Bone& bone, std::mt19937& random, ChangeSink& sink) {
    const auto slot = static_cast<std::int32_t>(random() % bone.stored_bricks());
    const auto fractions = bone.fractions(slot);
    const std::size_t first = random() % brick_voxel_count;
    const std::size_t room = brick_edge_voxels - first % brick_edge_voxels;
    const std::size_t count = 1 + random() % room;
    for (std::size_t voxel = first; voxel < first + count; ++voxel) {
        const unsigned left = fractions[voxel];
        fractions[voxel] =
            random() % 4 == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(random() % (left + 1));
    }
    sink.push(
        {bone.content().brick_of_slot[static_cast<std::size_t>(slot)], VoxelMask().set_run(first, count)},
        fractions);
}

}  // namespace osteomill::testing
