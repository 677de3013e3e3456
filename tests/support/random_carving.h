// Lowers fractions here and there, as milling would report it.
#pragma once

#include <random>

#include "common/bone/edit.h"

namespace osteomill::testing {

/// Carves one run at a random place of the bone and reports it.
inline void carve_somewhere(Bone& bone, std::mt19937& random, EditSink& sink) {
    const auto slot = static_cast<std::int32_t>(random() % bone.stored_bricks());
    EditRun run{.brick = bone.content().brick_of_slot[static_cast<std::size_t>(slot)],
                .first_voxel = static_cast<std::uint16_t>(random() % brick_voxel_count)};
    const int room = brick_edge_voxels - run.first_voxel % brick_edge_voxels;
    run.count = static_cast<std::uint8_t>(1 + random() % static_cast<unsigned>(room));
    for (std::size_t i = 0; i < run.count; ++i) {
        const unsigned left = bone.fractions(slot)[run.first_voxel + i];
        run.fraction[i] =
            random() % 4 == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(random() % (left + 1));
    }
    apply(run, bone);
    sink.push(run);
}

}  // namespace osteomill::testing
