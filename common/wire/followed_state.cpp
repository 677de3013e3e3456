#include "common/wire/followed_state.h"

#include <utility>

namespace osteomill {

std::variant<FollowedState, WireError> follow(const StateArrived& arrived, BoneReplica& replica) {
    FollowedState followed;
    for (const ChangedBrick& changed : arrived.changes) {
        auto corrected = replica.correct(changed);
        if (auto* error = std::get_if<WireError>(&corrected)) return std::move(*error);
        if (changed.change.kind == ChangeKind::milled &&
            std::get<Correction>(corrected) == Correction::raises)
            followed.has_regained_bone = true;
    }
    if (arrived.bone_checksum)
        followed.check =
            *arrived.bone_checksum == replica.checksum() ? ReplicaCheck::equal : ReplicaCheck::differs;
    return followed;
}

}  // namespace osteomill
