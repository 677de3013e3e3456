#include "render_client/volume/visible_bone.h"

#include <algorithm>

namespace osteomill {

VisibleBone::VisibleBone(const Bone& bone, const LookTable& table)
    : channel_(table.channel), shown_part_(shown_part_by_code(table)), visible_(bone) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        take_over(bone, static_cast<std::int32_t>(slot));
}

void VisibleBone::follow(const Bone& bone, std::span<const BrickIndex> dirty) {
    for (const BrickIndex brick : dirty)
        if (const std::int32_t slot = bone.slot(brick); slot != BoneContent::no_slot) take_over(bone, slot);
}

void VisibleBone::take_over(const Bone& bone, std::int32_t slot) {
    const auto whole = bone.fractions(slot);
    const auto shown = visible_.fractions(slot);
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
        const std::uint8_t code = channel_ ? channel_of_slot(bone, *channel_, slot)[offset] : std::uint8_t{0};
        shown[offset] = static_cast<std::uint8_t>((whole[offset] * shown_part_[code] + 127) / 255);
    }
}

bool hides_bone(const LookTable& table) {
    const auto parts = shown_part_by_code(table);
    return std::any_of(parts.begin(), parts.end(), [](std::uint8_t part) { return part < 255; });
}

}  // namespace osteomill
