#include "analysis/replay/removal_count.h"

#include <algorithm>

namespace osteomill {

namespace {

void add_brick(const Bone& bone, std::int32_t slot, int sign, std::array<std::int64_t, 256>& codes) {
    const auto fractions = bone.fractions(slot);
    for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
        codes[bone.content().tissue_in(slot, voxel)] += sign * fractions[voxel];
}

}  // namespace

void RemovalCount::before(const Bone& bone, const std::vector<ChangedBrick>& next) {
    slots_.clear();
    for (const ChangedBrick& changed : next)
        if (const std::int32_t slot = bone.slot(changed.change.brick); slot != BoneContent::no_slot)
            slots_.insert(slot);
    for (const std::int32_t slot : slots_) add_brick(bone, slot, 1, codes_);
}

void RemovalCount::after(const Bone& bone) {
    for (const std::int32_t slot : slots_) add_brick(bone, slot, -1, codes_);
    slots_.clear();
}

std::array<double, 256> RemovalCount::removed_mm3(const Grid& grid) const {
    std::array<double, 256> removed{};
    std::ranges::transform(codes_, removed.begin(), [&](std::int64_t codes) {
        return static_cast<double>(codes) / 255.0 * voxel_volume_mm3(grid);
    });
    return removed;
}

}  // namespace osteomill
