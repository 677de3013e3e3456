#include "common/wire/bone_follower.h"

#include <algorithm>
#include <utility>

#include "common/wire/brick_edit.h"
#include "common/wire/scene_messages.h"

namespace osteomill {

std::variant<BoneFollower::Applied, WireError> BoneFollower::apply(const v1::StateFrame& frame,
                                                                   std::vector<BrickIndex>& dirty) {
    auto tool = tool_from(frame.tool(), burr_count_);
    if (auto* error = std::get_if<WireError>(&tool)) return std::move(*error);
    Applied applied{.tool = std::get<ToolView>(std::move(tool))};
    for (const v1::BrickEdit& edit : frame.edits()) {
        auto written = correct_with_brick_edit(edit, bone_);
        if (auto* error = std::get_if<WireError>(&written)) return std::move(*error);
        if (std::get<EditEffect>(written) == EditEffect::raises) applied.has_regained_bone = true;
        checksum_.update(bone_, bone_.slot(edit.brick()));
        dirty.push_back(edit.brick());
    }
    if (frame.bone_checksum() != 0)
        applied.check = frame.bone_checksum() == checksum_.value() ? CopyCheck::equal : CopyCheck::differs;
    return applied;
}

void BoneFollower::set_fractions(BrickIndex brick,
                                 std::span<const std::uint8_t, brick_voxel_count> fractions) {
    const std::int32_t slot = bone_.slot(brick);
    std::ranges::copy(fractions, bone_.fractions(slot).begin());
    checksum_.update(bone_, slot);
}

}  // namespace osteomill
