// Weight of each removed voxel in the force: relative stiffness times the fraction that it lost.
#pragma once

#include <cstddef>
#include <span>

#include "common/bone/bone.h"
#include "simulation/carving/removed_voxels.h"

namespace osteomill {

/// Relative stiffness times the fraction that each voxel lost; zero for padding. `weights` has space for
/// removed.padded_count(). Real-time safe.
inline void weigh_by_stiffness(const BoneContent& content, const RemovedVoxels& removed,
                               std::span<float> weights) noexcept {
    if (content.stiffness.empty()) {
        const auto per_code = static_cast<float>(content.homogeneous_stiffness / 255.0);
        for (std::size_t i = 0; i < removed.padded_count(); ++i) weights[i] = per_code * removed.levels[i];
        return;
    }
    const auto per_code = static_cast<float>(content.stiffness_per_code / 255.0);
    for (std::size_t i = 0; i < removed.count; ++i) {
        const ByteBrick& stiffness = content.stiffness[static_cast<std::size_t>(removed.slot[i])];
        weights[i] = per_code * static_cast<float>(stiffness[static_cast<std::size_t>(removed.offset[i])]) *
                     removed.levels[i];
    }
    for (std::size_t i = removed.count; i < removed.padded_count(); ++i) weights[i] = 0.0f;
}

}  // namespace osteomill
