// A state frame, applied to a replica of the bone that is kept equal to the server's.
#pragma once

#include <variant>
#include <vector>

#include "common/scene/session_control.h"
#include "common/scene/structure_distance.h"
#include "common/scene/tool_state.h"
#include "common/wire/bone_replica.h"
#include "common/wire/session_info.h"
#include "common/wire/wire_error.h"
#include "osteomill/v1/session.pb.h"

namespace osteomill {

/// What the checksum of a frame shows of a replica.
enum class ReplicaCheck {
    none,     ///< the frame stated none
    equal,    ///< the replica has it
    differs,  ///< the replica has another
};

struct FollowedState {
    ToolState tool;
    ReplicaCheck check = ReplicaCheck::none;
    std::vector<ControlEvent> events{};
    SessionStatus status{};
    std::vector<StructureDistance> distances{};  ///< to protected structures that are near or were touched
    /// An edit raised what was left, as milling cannot: the replica had lost bone, and has it again. Those
    /// that restore bone are no such edits.
    bool has_regained_bone = false;
};

/// `session`: to check the frame against. After an error part of the frame may have been
/// applied: a fresh bone is needed.
std::variant<FollowedState, WireError> follow(const v1::StateFrame& frame, const SessionInfo& session,
                                              BoneReplica& replica);

}  // namespace osteomill
