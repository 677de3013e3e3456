#include "common/wire/bone_follower.h"

#include <algorithm>
#include <utility>

#include "common/wire/brick_edit.h"
#include "common/wire/scene_messages.h"

namespace osteomill {

std::variant<BoneFollower::Applied, BoneDiffers, WireError> BoneFollower::apply(
    const v1::StateFrame& frame, std::vector<BrickIndex>& dirty) {
    auto tool = tool_from(frame.tool(), burr_count_);
    if (auto* error = std::get_if<WireError>(&tool)) return std::move(*error);
    for (const v1::BrickEdit& edit : frame.edits()) {
        if (auto error = apply_brick_edit(edit, bone_)) return std::move(*error);
        checksum_.update(bone_, bone_.slot(edit.brick()));
        dirty.push_back(edit.brick());
    }
    const bool states_checksum = frame.bone_checksum() != 0;
    if (states_checksum && frame.bone_checksum() != checksum_.value()) return BoneDiffers{};
    return Applied{std::get<ToolView>(std::move(tool)), states_checksum};
}

void BoneFollower::set_fractions(BrickIndex brick,
                                 std::span<const std::uint8_t, brick_voxel_count> fractions) {
    const std::int32_t slot = bone_.slot(brick);
    std::ranges::copy(fractions, bone_.fractions(slot).begin());
    checksum_.update(bone_, slot);
}

}  // namespace osteomill
