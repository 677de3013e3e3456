#include "render_client/volume/textures/visible_bone.h"

#include <algorithm>
#include <array>

namespace osteomill {

VisibleBone::VisibleBone(const Bone& bone, const LookTable& table)
    : channel_(table.channel), shown_part_(shown_part_by_code(table)), visible_(bone) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        take_over(bone, static_cast<std::int32_t>(slot));
}

void VisibleBone::follow(const Bone& bone, std::span<const BrickChange> changes) {
    for (const BrickChange& change : changes)
        if (const std::int32_t slot = bone.slot(change.brick); slot != BoneContent::no_slot)
            take_over(bone, slot);
}

void VisibleBone::take_codes(const Bone& bone, std::int32_t slot) {
    if (channel_ != BoneChannel::stiffness) {
        if (channel_) std::ranges::copy(channel_of_slot(bone, *channel_, slot), codes_.begin());
        return;
    }
    const BoneContent& content = bone.content();
    const glm::ivec3 brick =
        brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
    constexpr std::size_t edge = brick_edge_voxels + 2;
    std::array<std::uint8_t, edge * edge * edge> nearby{};
    copy_channel(bone, BoneChannel::stiffness,
                 {brick * brick_edge_voxels - 1, glm::ivec3(brick_edge_voxels + 2)}, nearby);
    // The largest of 27 is the largest of three, along each axis in turn; in place, since what is overwritten
    // is not read again.
    for (const std::size_t stride : {std::size_t{1}, edge, edge * edge})
        for (std::size_t place = 0; place + 2 * stride < nearby.size(); ++place)
            nearby[place] = std::max({nearby[place], nearby[place + stride], nearby[place + 2 * stride]});
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
        const glm::uvec3 voxel(voxel_in_brick(offset));
        codes_[offset] = nearby[voxel.x + edge * (voxel.y + edge * voxel.z)];
    }
}

void VisibleBone::take_over(const Bone& bone, std::int32_t slot) {
    take_codes(bone, slot);
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
