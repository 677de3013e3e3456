// CT numbers on a bone's grid as a whole, with an optional label per voxel, for tests: the product has them
// slice by slice.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "imaging/bone_from_hu.h"

namespace osteomill {

struct HuVolume {
    Grid grid;
    std::vector<std::int16_t> hu;      ///< x fastest, then y, then z
    std::vector<std::uint8_t> tissue;  ///< labels in the same order, or empty
};

/// The volume's slices; it must outlive them.
inline HuSlices slices_of(const HuVolume& volume) {
    return {.grid = volume.grid,
            .labelled = !volume.tissue.empty(),
            .read = [&volume, at = std::size_t{0}](std::span<std::int16_t> hu,
                                                   std::span<std::uint8_t> tissue) mutable {
                std::copy_n(volume.hu.begin() + static_cast<std::ptrdiff_t>(at), hu.size(), hu.begin());
                if (!tissue.empty())
                    std::copy_n(volume.tissue.begin() + static_cast<std::ptrdiff_t>(at), tissue.size(),
                                tissue.begin());
                at += hu.size();
            }};
}

inline Bone bone_from_hu(const HuVolume& volume, double threshold_hu, const StiffnessRelation& relation) {
    return bone_from_hu(slices_of(volume), threshold_hu, relation);
}

}  // namespace osteomill
