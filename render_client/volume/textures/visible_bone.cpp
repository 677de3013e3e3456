#include "render_client/volume/textures/visible_bone.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace osteomill {

VisibleBone::VisibleBone(const TransferTable& table)
    : voxel_codes_(table.codes), shown_part_(shown_part_by_code(table)) {}

VisibleBone::VisibleBone(const Bone& bone, const TransferTable& table) : VisibleBone(table) {
    finish(fill(bone));
}

Steps VisibleBone::fill(const Bone& bone) {
    std::vector<ByteBrick> fractions;
    fractions.reserve(bone.stored_bricks());
    while (fractions.size() < bone.stored_bricks()) {
        const auto slot = static_cast<std::int32_t>(fractions.size());
        take_over(bone, slot, fractions.emplace_back());
        co_yield static_cast<double>(slot) / static_cast<double>(bone.stored_bricks());
    }
    visible_.emplace(bone.shared_content(), std::move(fractions));
}

void VisibleBone::follow(const Bone& bone, std::span<const BrickChange> changes) {
    for (const BrickChange& change : changes)
        if (const std::int32_t slot = bone.slot(change.brick); slot != BoneContent::no_slot)
            take_over(bone, slot, visible_->fractions(slot));
}

void VisibleBone::take_over(const Bone& bone, std::int32_t slot,
                            std::span<std::uint8_t, brick_voxel_count> shown) {
    const BoneContent& content = bone.content();
    const glm::ivec3 brick =
        brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
    copy_stiffest_codes(bone, voxel_codes_, {brick * brick_edge_voxels, glm::ivec3(brick_edge_voxels)},
                        codes_);
    const auto whole = bone.fractions(slot);
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
        shown[offset] = static_cast<std::uint8_t>((whole[offset] * shown_part_[codes_[offset]] + 127) / 255);
}

bool hides_bone(const TransferTable& table) {
    const auto parts = shown_part_by_code(table);
    return std::any_of(parts.begin(), parts.end(), [](std::uint8_t part) { return part < 255; });
}

}  // namespace osteomill
