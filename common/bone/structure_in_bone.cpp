#include "common/bone/structure_in_bone.h"

#include <algorithm>
#include <utility>

namespace osteomill {

StructureMask structure_in_bone(const Bone& bone, std::uint8_t label) {
    const BoneContent& content = bone.content();
    std::vector<StructureBrick> bricks;
    for (std::size_t slot = 0; slot < content.tissue.size(); ++slot) {
        VoxelMask voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (content.tissue[slot][offset] == label) voxels.set(offset);
        if (voxels.any()) bricks.push_back({content.brick_of_slot[slot], voxels});
    }
    return {bone.grid(), std::move(bricks)};
}

bool brick_has_label(const Bone& bone, std::size_t slot, std::uint8_t label) {
    const ByteBrick& labels = bone.content().tissue[slot];
    auto at = std::ranges::find(labels, label);
    if (at == labels.end()) return false;
    const BrickFractions fractions = bone.fractions(static_cast<std::int32_t>(slot));
    for (; at != labels.end(); ++at)
        if (*at == label && fractions[static_cast<std::size_t>(at - labels.begin())] > 0) return true;
    return false;
}

}  // namespace osteomill
