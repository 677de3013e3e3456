#include "render_client/volume/textures/visible_bone.h"

#include <algorithm>
#include <array>

namespace osteomill {

VisibleBone::VisibleBone(const Bone& bone, const LookTable& table)
    : voxel_codes_(table.codes), shown_part_(shown_part_by_code(table)), visible_(bone) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        take_over(bone, static_cast<std::int32_t>(slot));
}

void VisibleBone::follow(const Bone& bone, std::span<const BrickChange> changes) {
    for (const BrickChange& change : changes)
        if (const std::int32_t slot = bone.slot(change.brick); slot != BoneContent::no_slot)
            take_over(bone, slot);
}

void VisibleBone::take_over(const Bone& bone, std::int32_t slot) {
    const BoneContent& content = bone.content();
    const glm::ivec3 brick =
        brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
    copy_stiffest_codes(bone, voxel_codes_, {brick * brick_edge_voxels, glm::ivec3(brick_edge_voxels)},
                        codes_);
    const auto whole = bone.fractions(slot);
    const auto shown = visible_.fractions(slot);
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
        shown[offset] = static_cast<std::uint8_t>((whole[offset] * shown_part_[codes_[offset]] + 127) / 255);
}

bool hides_bone(const LookTable& table) {
    const auto parts = shown_part_by_code(table);
    return std::any_of(parts.begin(), parts.end(), [](std::uint8_t part) { return part < 255; });
}

}  // namespace osteomill
